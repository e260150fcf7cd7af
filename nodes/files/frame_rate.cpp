#include "nodes/files/frame_rate.h"

#include <algorithm>
#include <cmath>

#include "nodes/files/decimal.h"

namespace kinegraph {

namespace {

constexpr int customary[] = {120, 60, 30,  24,  25,  50,  100, 240, 90,
                             48,  72, 144, 200, 250, 300, 480, 500, 1000};

// Digits after the point of the number without its exponent, plus the exponent's shift.
int decimals_of(std::string_view text) {
  int decimals = 0;
  bool after_point = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '.') after_point = true;
    if (text[i] >= '0' && text[i] <= '9') decimals += after_point;
    if ((text[i] | 0x20) == 'e') {
      double exponent = 0;
      if (!whole_number_text(text.substr(i + 1), exponent)) return 0;
      return static_cast<int>(std::clamp(decimals - exponent, 0.0, 60.0));
    }
  }
  return std::min(decimals, 60);
}

}  // namespace

double rate_of_frame_time(std::string_view text) {
  double time = 0;
  if (!whole_number_text(text, time) || !(time > 0) || !std::isfinite(1 / time)) return 0;
  // Doubles carry 17 digits; what lies beyond can't be compared.
  const int decimals = std::min(decimals_of(text), 17);
  const double scale = decimal_detail::powers_of_ten[decimals];
  const double digits = time * scale;
  auto agrees = [&](double rate) {
    double period = scale / rate;
    double slack =
        0.5 + 1e-15 * period;  // the text may have been rounded or, with many digits, be a double's own
    return rate >= 1 && std::fabs(period - digits) <= slack;
  };
  const double nearest = std::round(1 / time);
  if (agrees(nearest)) {
    bool exact = std::fabs(nearest * time - 1) < 1e-14;
    if (exact) return nearest;
    for (int rate : customary)
      if (agrees(rate)) return rate;
    return nearest;
  }
  return 1 / time;
}

std::string frame_time_of_rate(double fps, std::string_view as_read) {
  if (!as_read.empty() && rate_of_frame_time(as_read) == fps) return std::string(as_read);
  std::string text;
  append_shortest(text, 1 / fps);
  return text;
}

}  // namespace kinegraph
