#include "nodes/time/lowpass.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/elementary.h"

namespace kinegraph {

Lowpass::Lowpass(double fps, double cutoff, int order) {
  if (!(2 * cutoff < fps)) return;
  // The bilinear transform of the poles exp(i π (1/2 + (2k + 1)/(2n))), with its warping of frequency made
  // good.
  auto [sin, cos] = sin_cos(pi * cutoff / fps);
  double k = sin / cos;
  for (int i = 0; i < order / 2; ++i) {
    double damping = 2 * sine(pi * (2 * i + 1) / (2.0 * order));  // 1/Q
    double norm = 1 / (1 + k * damping + k * k);
    double b = k * k * norm;
    sections_.push_back({b, 2 * b, b, 2 * (k * k - 1) * norm, (1 - k * damping + k * k) * norm});
  }
  if (order % 2 == 1) {
    double b = k / (1 + k);
    sections_.push_back({b, b, 0, (k - 1) / (k + 1), 0});
  }
  // A pole of radius r has fallen to e^-23 after 23 / -ln r samples.
  double radius = 0;
  for (const Section& s : sections_)
    radius = std::fmax(radius, s.b2 == 0 ? std::fabs(s.a1) : std::sqrt(s.a2));
  double samples = radius > 1e-4 ? std::ceil(23 / -logarithm(radius)) : 3;
  memory_ = static_cast<std::size_t>(std::fmin(samples, 1e6)) + 3;
}

// Each section starts as if the first sample had stood there for ever.
void Lowpass::pass(std::span<double> series) const {
  for (const Section& s : sections_) {
    double s2 = (s.b2 - s.a2) * series[0];
    double s1 = (s.b1 - s.a1) * series[0] + s2;
    for (double& x : series) {
      double y = s.b0 * x + s1;
      s1 = s.b1 * x - s.a1 * y + s2;
      s2 = s.b2 * x - s.a2 * y;
      x = y;
    }
  }
}

void Lowpass::apply(std::span<double> series) const {
  if (passes_all() || series.size() < 2) return;
  auto pad = static_cast<std::ptrdiff_t>(memory_);
  auto count = static_cast<std::ptrdiff_t>(series.size());
  std::vector<double> longer(series.size() + 2 * memory_);
  for (std::ptrdiff_t i = -pad; i < count + pad; ++i) longer[i + pad] = reflected(series, i);
  apply_to_continued(longer);
  std::copy_n(longer.begin() + pad, count, series.begin());
}

void Lowpass::apply_to_continued(std::span<double> series) const {
  if (passes_all() || series.empty()) return;
  pass(series);
  std::reverse(series.begin(), series.end());
  pass(series);
  std::reverse(series.begin(), series.end());
}

std::vector<double> lowpass(std::span<const double> series, double fps, double cutoff, int order) {
  std::vector<double> result(series.begin(), series.end());
  Lowpass(fps, cutoff, order).apply(result);
  return result;
}

double reflected(std::span<const double> series, std::ptrdiff_t index) {
  auto last = static_cast<std::ptrdiff_t>(series.size()) - 1;
  if (index >= 0 && index <= last) return series[index];
  if (last == 0) return series[0];
  // Each reflection at both ends carries a whole swing over: 2 (x_last - x_0) a period.
  std::ptrdiff_t period = 2 * last;
  std::ptrdiff_t periods = index >= 0 ? index / period : -((-index + period - 1) / period);
  std::ptrdiff_t rest = index - periods * period;
  double carried = static_cast<double>(periods) * 2 * (series[last] - series[0]);
  return carried + (rest <= last ? series[rest] : 2 * series[last] - series[period - rest]);
}

}  // namespace kinegraph
