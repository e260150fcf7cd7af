// Decimal text to double and back, whatever the locale. Reading gives the same bits as std::from_chars;
// writing is exact.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace kinegraph {

// Reads one number of the form [+-] digits [. digits] [e [+-] digits] that starts at `from`, and returns the
// end of it; null when none starts there (also for "nan", "inf") or when it is too large for a double. Too
// small gives 0. The whole text may be followed by anything; nothing at or after `end` is read.
const char* parse_decimal_slow(const char* from, const char* end, double& value);

namespace decimal_detail {

inline constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                           1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                           1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
inline constexpr std::uint64_t integer_powers[] = {1,      10,      100,      1000,     10000,
                                                   100000, 1000000, 10000000, 100000000};
constexpr std::uint64_t power_of_ten(int exponent) {
  return exponent == 0 ? 1 : 10 * power_of_ten(exponent - 1);
}

struct Digits {
  std::uint64_t value;
  int count;  // 0 to 8
};
// The run of digits at `at`, up to eight, without a branch. Eight bytes are read.
inline Digits digits_at(const char* at) {
  std::uint64_t bytes;
  std::memcpy(&bytes, at, 8);
  bytes ^= 0x3030303030303030u;
  // A byte over 9 sets its top bit; a carry can only reach bytes after the first such one.
  std::uint64_t others = ((bytes + 0x7676767676767676u) | bytes) & 0x8080808080808080u;
  int count = others ? std::countr_zero(others) >> 3 : 8;
  int half_shift = 4 * (8 - count);  // in two halves, as a shift by 64 is undefined
  bytes = (bytes << half_shift) << half_shift;
  bytes = ((bytes & 0x0F0F0F0F0F0F0F0Fu) * 2561) >> 8;
  bytes = ((bytes & 0x00FF00FF00FF00FFu) * 6553601) >> 16;
  bytes = ((bytes & 0x0000FFFF0000FFFFu) * 42949672960001u) >> 32;
  return {bytes, count};
}

}  // namespace decimal_detail

// As parse_decimal_slow, fast for the numbers that motion files hold: a mantissa below 2^53 times or over a
// power of ten up to 10^22 is exact in both factors, so one rounded operation gives the nearest double
// (Clinger 1990).
inline const char* parse_decimal(const char* from, const char* end, double& value) {
  using namespace decimal_detail;
  if (end - from < 40) return parse_decimal_slow(from, end, value);
  const char* at = from;
  bool negative = *at == '-';
  at += negative;
  Digits whole = digits_at(at);
  if (whole.count == 8) return parse_decimal_slow(from, end, value);
  at += whole.count;
  std::uint64_t mantissa = whole.value;
  int decimals = 0;
  if (*at == '.') {
    Digits part = digits_at(++at);
    at += part.count;
    decimals = part.count;
    mantissa = mantissa * integer_powers[part.count] + part.value;
    if (part.count == 8) {
      part = digits_at(at);
      at += part.count;
      decimals += part.count;
      if (decimals + whole.count > 19 || part.count == 8) return parse_decimal_slow(from, end, value);
      mantissa = mantissa * integer_powers[part.count] + part.value;
    }
  }
  if (whole.count + decimals == 0) return parse_decimal_slow(from, end, value);
  int exponent = -decimals;
  if ((*at | 0x20) == 'e') {
    const char* digit = at + 1;
    bool minus = *digit == '-';
    digit += minus || *digit == '+';
    Digits power = digits_at(digit);
    if (power.count == 0 || power.count > 3) return parse_decimal_slow(from, end, value);
    at = digit + power.count;
    exponent += minus ? -static_cast<int>(power.value) : static_cast<int>(power.value);
  }
  if (mantissa > (std::uint64_t{1} << 53) || exponent < -22 || exponent > 22)
    return parse_decimal_slow(from, end, value);
  double number = static_cast<double>(mantissa);
  number = exponent < 0 ? number / powers_of_ten[-exponent] : number * powers_of_ten[exponent];
  value = negative ? -number : number;
  return at;
}

// The whole of `text` as a number.
bool whole_number_text(std::string_view text, double& value);

// Room that append_fixed_at may need: sign, 309 digits, point, decimals.
inline constexpr int fixed_room = 340;
// Writes a finite `value` with `decimals` (0 to 17) digits after the point, rounded exactly (ties to even),
// "-0.000" as "0.000"; returns the end. `at` has fixed_room bytes.
char* write_fixed(char* at, double value, int decimals);
void append_fixed(std::string& out, double value, int decimals);
// The shortest decimal that reads back the same double; -0 as "0".
void append_shortest(std::string& out, double value);

}  // namespace kinegraph
