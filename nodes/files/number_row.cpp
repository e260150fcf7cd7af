#include "nodes/files/number_row.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "nodes/files/decimal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/files/number_row.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef KINEGRAPH_NUMBER_ROW_SCRATCH
#define KINEGRAPH_NUMBER_ROW_SCRATCH
namespace kinegraph {
struct RowScratch {
  std::uint32_t *starts, *points, *ends, *odd_ones;
  std::uint64_t *whole, *part;
  std::uint8_t* odd;
};
constexpr std::size_t row_room = 8;  // that the scratch has past the last number
}  // namespace kinegraph
#endif

HWY_BEFORE_NAMESPACE();
namespace kinegraph {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t block = 64;   // bytes marked at once, a bit each
constexpr std::size_t beyond = 32;  // bytes past a block that the words in it may be read to

struct Kinds {
  std::uint64_t blank, line_end, digit, point, minus;
};

#if HWY_TARGET == HWY_SCALAR  // lanes of one byte
HWY_INLINE Kinds kinds_of(const char* at) {
  Kinds kinds{};
  for (std::size_t i = 0; i < block; ++i) {
    const char c = at[i];
    const auto bit = [&](bool is) { return static_cast<std::uint64_t>(is) << i; };
    kinds.blank |= bit(c == ' ' || c == '\t');
    kinds.line_end |= bit(c == '\n' || c == '\r');
    kinds.digit |= bit(c >= '0' && c <= '9');
    kinds.point |= bit(c == '.');
    kinds.minus |= bit(c == '-');
  }
  return kinds;
}
#else
HWY_INLINE Kinds kinds_of(const char* at) {
  const hn::CappedTag<std::uint8_t, block> d;
  std::uint8_t bits[5][block / 8];
  for (std::size_t i = 0; i < block; i += hn::Lanes(d)) {
    const auto bytes = hn::LoadU(d, reinterpret_cast<const std::uint8_t*>(at) + i);
    const auto byte = [&](char c) { return hn::Set(d, static_cast<std::uint8_t>(c)); };
    const auto is = [&](char c) { return hn::Eq(bytes, byte(c)); };
    hn::StoreMaskBits(d, hn::Or(is(' '), is('\t')), bits[0] + i / 8);
    hn::StoreMaskBits(d, hn::Or(is('\n'), is('\r')), bits[1] + i / 8);
    const auto above = hn::Sub(bytes, byte('0'));
    hn::StoreMaskBits(d, hn::Eq(hn::Min(above, byte('\x9')), above), bits[2] + i / 8);
    hn::StoreMaskBits(d, is('.'), bits[3] + i / 8);
    hn::StoreMaskBits(d, is('-'), bits[4] + i / 8);
  }
  std::uint64_t words[5];
  std::memcpy(words, bits, sizeof words);
  return {words[0], words[1], words[2], words[3], words[4]};
}
#endif

// Appends where bits are set, by fours: what follows the last is overwritten later.
HWY_INLINE void append(std::uint64_t bits, std::uint32_t from, std::size_t more, std::uint32_t* to) {
  for (std::size_t i = 0; i < more; i += 4)
    for (std::size_t k = 0; k < 4; ++k) {
      to[i + k] = from + static_cast<std::uint32_t>(std::countr_zero(bits));
      bits &= bits - 1;
    }
}

// Fills starts, points, ends and odd with the words up to the line's end; false where they aren't `count`.
HWY_INLINE bool mark_line(const char* line, const char* end, std::size_t count, const RowScratch& row) {
  std::memset(row.odd, 0, count);
  std::size_t starts = 0, points = 0, ends = 0;
  std::uint64_t inside = 0;  // whether the last byte belonged to a word
  std::uint64_t carry = 0;   // and to one that had no point yet
  for (const char* at = line;; at += block) {
    if (end - at < static_cast<std::ptrdiff_t>(block + beyond)) return false;
    const Kinds kinds = kinds_of(at);
    std::uint64_t words = ~(kinds.blank | kinds.line_end);
    if (kinds.line_end) words &= (kinds.line_end & (~kinds.line_end + 1)) - 1;
    const std::uint64_t after = words << 1 | inside;
    const std::uint64_t start = words & ~after, stop = after & ~words;
    inside = words >> 63;
    // Adding each start to the run of bytes from it on ends in the first bit past that: its point, or its
    // end.
    const std::uint64_t run = words & ~kinds.point;
    const std::uint64_t sum = run + start, all = sum + carry;
    const std::uint64_t point = all & ~run;
    carry = (sum < run) | (all < sum);

    const auto new_starts = static_cast<std::size_t>(std::popcount(start));
    const auto new_points = static_cast<std::size_t>(std::popcount(point));
    const auto new_ends = static_cast<std::size_t>(std::popcount(stop));
    if (starts + new_starts > count) return false;
    const auto from = static_cast<std::uint32_t>(at - line);
    append(start, from, new_starts, row.starts + starts);
    append(point, from, new_points, row.points + points);
    append(stop, from, new_ends, row.ends + ends);
    starts += new_starts;
    points += new_points;
    ends += new_ends;

    std::uint64_t odd = words & ~(kinds.digit | (kinds.minus & start) | (kinds.point & point));
    odd &= ~(odd << 1);  // one after another are of one word
    for (; odd; odd &= odd - 1) {
      const std::uint64_t up_to = odd ^ (odd - 1);
      row.odd[starts - new_starts + static_cast<std::size_t>(std::popcount(start & up_to)) - 1] = 1;
    }
    if (kinds.line_end) return starts == count;
  }
}

// The digits of each number, the last whole one in the highest byte, the first decimal in the lowest; the
// sign in the top bit of the decimals. Returns how many numbers are listed as odd.
HWY_INLINE std::size_t cut_digits(const char* line, std::size_t count, const RowScratch& row) {
  static constexpr std::uint64_t zeros = 0x3030303030303030u;
  static constexpr std::uint64_t kept[9] = {0,
                                            0xFF,
                                            0xFFFF,
                                            0xFFFFFF,
                                            0xFFFFFFFF,
                                            0xFFFFFFFFFF,
                                            0xFFFFFFFFFFFF,
                                            0xFFFFFFFFFFFFFF,
                                            0xFFFFFFFFFFFFFFFF};
  std::size_t odd = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t point = row.points[i], end = row.ends[i];
    const std::uint32_t minus = line[row.starts[i]] == '-';
    const std::uint32_t first = row.starts[i] + minus;
    const std::uint32_t whole = point - first, part = end - point - (end != point);
    row.odd_ones[odd] = static_cast<std::uint32_t>(i);
    odd += row.odd[i] | (whole > 7) | (part > 8) | (whole + part == 0);
    std::uint64_t bytes;
    std::memcpy(&bytes, line + first, 8);
    bytes ^= zeros;
    const std::uint32_t half_shift =
        4 * (8 - std::min(whole, 8u));  // in two halves, as one by 64 is undefined
    row.whole[i] = (bytes << half_shift) << half_shift;
    std::memcpy(&bytes, line + point + 1, 8);
    row.part[i] = ((bytes ^ zeros) & kept[std::min(part, 8u)]) | static_cast<std::uint64_t>(minus) << 63;
  }
  return odd;
}

using D = hn::ScalableTag<double>;
using U = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;

// Eight digits, the first in the lowest byte, to their value: by twos, fours, and both fours.
HWY_INLINE V value_of(hn::Vec<U> digits) {
  const D d;
  const U u;
#if HWY_TARGET == HWY_SCALAR  // has no lanes to part
  const std::uint64_t twos = ((hn::GetLane(digits) * 2561) >> 8) & 0x00FF00FF00FF00FFu;
  const std::uint64_t fours = ((twos * 6553601) >> 16) & 0x0000FFFF0000FFFFu;
  const auto both = hn::Set(u, (fours * 42949672960001u) >> 32);
#else
  const hn::Repartition<std::uint16_t, D> u16;
  const hn::Repartition<std::uint32_t, D> u32;
  const auto twos = hn::ShiftRight<8>(hn::Mul(hn::BitCast(u16, digits), hn::Set(u16, 10 * 256 + 1)));
  const auto fours = hn::ShiftRight<16>(hn::Mul(hn::BitCast(u32, twos), hn::Set(u32, 100 * 65536 + 1)));
  const auto both =
      hn::Add(hn::MulEven(fours, hn::Set(u32, 10000)), hn::ShiftRight<32>(hn::BitCast(u, fours)));
#endif
  // Put below the leading one of 2^52 it is a double, exactly.
  const V two_52 = hn::Set(d, 4503599627370496.0);
  return hn::Sub(hn::BitCast(d, hn::Or(both, hn::BitCast(u, two_52))), two_52);
}

HWY_INLINE V numbers_at(const RowScratch& row, std::size_t i) {
  const D d;
  const U u;
  const auto sign = hn::Set(u, std::uint64_t{1} << 63);
  const auto part = hn::LoadU(u, row.part + i);
  const V decimals = hn::Set(d, 1e8);
  // At most fifteen digits over a power of ten: both are exact, so the quotient is the nearest double.
  const V digits =
      hn::Add(hn::Mul(value_of(hn::LoadU(u, row.whole + i)), decimals), value_of(hn::AndNot(sign, part)));
  return hn::Or(hn::Div(digits, decimals), hn::BitCast(d, hn::And(sign, part)));
}

const char* ReadRow(const char* line, const char* end, std::size_t count, const RowScratch& row,
                    double* out) {
  if (!mark_line(line, end, count, row)) return nullptr;
  const std::size_t odd = cut_digits(line, count, row);
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(numbers_at(row, i), d, out + i);
  if (i < count) {
    HWY_ALIGN double rest[HWY_MAX_BYTES / sizeof(double)];
    hn::StoreU(numbers_at(row, i), d, rest);
    std::copy(rest, rest + (count - i), out + i);
  }
  for (std::size_t k = 0; k < odd; ++k) {  // long numbers, exponents, and what is no number
    i = row.odd_ones[k];
    if (parse_decimal(line + row.starts[i], end, out[i]) != line + row.ends[i]) return nullptr;
  }
  return line + row.ends[count - 1];
}

}  // namespace HWY_NAMESPACE
}  // namespace kinegraph
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinegraph {

HWY_EXPORT(ReadRow);

NumberRow::NumberRow(std::size_t count)
    : count_(count),
      starts_(count + row_room),
      points_(count + row_room),
      ends_(count + row_room),
      odd_ones_(count + row_room),
      whole_(count + row_room),
      part_(count + row_room),
      odd_(count + row_room) {}

const char* NumberRow::read(const char* line, const char* end, double* out) {
  if (count_ == 0) return nullptr;
  const RowScratch row{starts_.data(), points_.data(), ends_.data(), odd_ones_.data(),
                       whole_.data(),  part_.data(),   odd_.data()};
  return HWY_DYNAMIC_DISPATCH(ReadRow)(line, end, count_, row, out);
}

}  // namespace kinegraph
#endif  // HWY_ONCE
