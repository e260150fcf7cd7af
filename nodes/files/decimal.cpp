#include "nodes/files/decimal.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace kinegraph {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

const char* parse_decimal_slow(const char* from, const char* end, double& value) {
  const char* start = from;
  if (start < end && *start == '+') ++start;
  const char* digit = start;
  if (digit < end && *digit == '-') {
    if (start != from) return nullptr;
    ++digit;
  }
  bool has_digit = digit < end && is_digit(*digit);
  if (!has_digit && digit + 1 < end && *digit == '.') has_digit = is_digit(digit[1]);
  if (!has_digit) return nullptr;  // keeps out "nan", "inf" and lone signs
  auto [stop, problem] = std::from_chars(start, end, value);
  if (problem == std::errc{}) return stop;
  if (problem != std::errc::result_out_of_range) return nullptr;
  // Out of range in either direction: a number below the smallest double has a negative exponent or leading
  // zeros.
  const char* first = digit;
  while (first < stop && (*first == '0' || *first == '.')) ++first;
  bool negative_exponent = false;
  for (const char* c = digit; c + 1 < stop; ++c)
    if ((*c | 0x20) == 'e') negative_exponent = c[1] == '-';
  bool small_mantissa = false;
  for (const char* c = digit; c < stop && *c != 'e' && *c != 'E' && c < first; ++c)
    small_mantissa |= *c == '.';
  if (!negative_exponent && !small_mantissa) return nullptr;
  value = digit != start ? -0.0 : 0.0;
  return stop;
}

bool whole_number_text(std::string_view text, double& value) {
  if (text.empty()) return false;
  return parse_decimal(text.data(), text.data() + text.size(), value) == text.data() + text.size();
}

namespace {

struct PairTable {
  char digits[200];
  constexpr PairTable() : digits() {
    for (int i = 0; i < 100; ++i) {
      digits[2 * i] = static_cast<char>('0' + i / 10);
      digits[2 * i + 1] = static_cast<char>('0' + i % 10);
    }
  }
};
constexpr PairTable pairs;

char* write_integer(char* at, std::uint64_t value) {
  if (value < 10) {
    *at = static_cast<char>('0' + value);
    return at + 1;
  }
  if (value < 100) {
    std::memcpy(at, pairs.digits + 2 * value, 2);
    return at + 2;
  }
  if (value < 1000) {
    *at = static_cast<char>('0' + value / 100);
    std::memcpy(at + 1, pairs.digits + 2 * (value % 100), 2);
    return at + 3;
  }
  char buffer[20];
  char* first = buffer + 20;
  while (value >= 100) {
    first -= 2;
    std::memcpy(first, pairs.digits + 2 * (value % 100), 2);
    value /= 100;
  }
  if (value >= 10) {
    first -= 2;
    std::memcpy(first, pairs.digits + 2 * value, 2);
  } else {
    *--first = static_cast<char>('0' + value);
  }
  auto count = static_cast<std::size_t>(buffer + 20 - first);
  std::memcpy(at, first, count);
  return at + count;
}

// `scaled` / 10^decimals; the divisor is a constant, which makes the division a multiplication.
template <int decimals>
char* write_scaled(char* at, std::uint64_t scaled) {
  constexpr std::uint64_t scale = decimal_detail::power_of_ten(decimals);
  at = write_integer(at, scaled / scale);
  if (decimals == 0) return at;
  *at++ = '.';
  auto part = static_cast<std::uint32_t>(scaled % scale);
  int left = decimals;
  for (; left >= 2; left -= 2) {
    std::memcpy(at + left - 2, pairs.digits + 2 * (part % 100), 2);
    part /= 100;
  }
  if (left) *at = static_cast<char>('0' + part);
  return at + decimals;
}

using WriteScaled = char* (*)(char*, std::uint64_t);
constexpr WriteScaled write_scaled_by[] = {write_scaled<0>, write_scaled<1>, write_scaled<2>, write_scaled<3>,
                                           write_scaled<4>, write_scaled<5>, write_scaled<6>, write_scaled<7>,
                                           write_scaled<8>, write_scaled<9>};

}  // namespace

char* write_fixed(char* at, double value, int decimals) {
  double size = std::fabs(value);
  double scaled = size * decimal_detail::powers_of_ten[decimals];
  // The product is off by at most half a unit in its last place: below 2^50 that is under 1/16, and only a
  // fraction that close to one half could round the wrong way.
  if (decimals <= 9 && scaled < 1125899906842624.0) {
    auto floor = static_cast<std::uint64_t>(scaled);
    double fraction = scaled - static_cast<double>(floor);
    double doubt = scaled * 0x1p-52;
    if (std::fabs(fraction - 0.5) > doubt) {
      std::uint64_t rounded = floor + (fraction > 0.5);
      if (value < 0 && rounded) *at++ = '-';
      return decimals == 6 ? write_scaled<6>(at, rounded) : write_scaled_by[decimals](at, rounded);
    }
  }
  auto written = std::to_chars(at, at + fixed_room, value, std::chars_format::fixed, decimals);
  if (*at == '-') {
    bool zero = true;
    for (const char* c = at + 1; c < written.ptr; ++c) zero &= *c == '0' || *c == '.';
    if (zero) {
      std::memmove(at, at + 1, static_cast<std::size_t>(written.ptr - at - 1));
      return written.ptr - 1;
    }
  }
  return written.ptr;
}

void append_fixed(std::string& out, double value, int decimals) {
  char buffer[fixed_room];
  out.append(buffer, write_fixed(buffer, value, decimals));
}

void append_shortest(std::string& out, double value) {
  char buffer[32];
  if (value == 0) value = 0;  // drops the sign of -0
  out.append(buffer, std::to_chars(buffer, buffer + 32, value).ptr);
}

}  // namespace kinegraph
