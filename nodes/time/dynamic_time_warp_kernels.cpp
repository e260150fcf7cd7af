#include "nodes/time/dynamic_time_warp_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/time/dynamic_time_warp_kernels.cpp"
// Arrays of vectors need vectors of a known size.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace kinegraph {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Doubles>;
constexpr std::size_t lanes = hn::MaxLanes(Doubles());
constexpr std::size_t vectors = warp_tile / lanes;
constexpr std::size_t rows_at_once = vectors >= 8 ? 1 : 8 / vectors;

template <std::size_t rows>
HWY_INLINE void tile_rows(const double* HWY_RESTRICT tile, std::size_t dims, const double* HWY_RESTRICT from,
                          double* HWY_RESTRICT out, std::size_t stride) {
  const Doubles tag;
  Vector sums[rows][vectors];
  HWY_UNROLL(8)
  for (std::size_t i = 0; i < rows; ++i) HWY_UNROLL(16)
  for (std::size_t v = 0; v < vectors; ++v) sums[i][v] = hn::Zero(tag);
  for (std::size_t d = 0; d < dims; ++d) {
    Vector frames[vectors];
    HWY_UNROLL(16)
    for (std::size_t v = 0; v < vectors; ++v) frames[v] = hn::LoadU(tag, tile + d * warp_tile + v * lanes);
    HWY_UNROLL(8)
    for (std::size_t i = 0; i < rows; ++i) {
      const Vector row = hn::Set(tag, from[i * dims + d]);
      HWY_UNROLL(16)
      for (std::size_t v = 0; v < vectors; ++v) {
        const Vector difference = hn::Sub(frames[v], row);
        sums[i][v] = hn::Add(sums[i][v], hn::Mul(difference, difference));
      }
    }
  }
  HWY_UNROLL(8)
  for (std::size_t i = 0; i < rows; ++i) HWY_UNROLL(16)
  for (std::size_t v = 0; v < vectors; ++v) hn::StoreU(sums[i][v], tag, out + i * stride + v * lanes);
}

void SquaredDistances(const double* tiles, std::size_t first_tile, std::size_t last_tile, std::size_t dims,
                      const double* rows, std::size_t row_count, double* out, std::size_t stride) {
  for (std::size_t t = first_tile; t < last_tile; ++t) {
    const double* tile = tiles + t * dims * warp_tile;
    double* column = out + t * warp_tile;
    std::size_t i = 0;
    for (; i + rows_at_once <= row_count; i += rows_at_once)
      tile_rows<rows_at_once>(tile, dims, rows + i * dims, column + i * stride, stride);
    for (; i < row_count; ++i) tile_rows<1>(tile, dims, rows + i * dims, column + i * stride, stride);
  }
}

// `fixed` > 0: steps = holds = fixed, known to the compiler.
template <std::size_t fixed>
HWY_INLINE void row_of(const WarpRow& row) {
  const Doubles tag;
  const hn::RebindToUnsigned<Doubles> wide_tag;
  using Mask = hn::Mask<Doubles>;
  const std::size_t steps = fixed ? fixed : row.steps;
  const std::size_t holds = fixed ? fixed : row.holds;
  const double shift = static_cast<double>(std::uint64_t{1} << row.code_shift);
  const hn::Rebind<std::int64_t, Doubles> int_tag;
  for (std::size_t f = row.begin; f < row.end; f += lanes) {
    const Vector cost = hn::LoadU(tag, row.cost + f);
    // Arriving by an advance. Ties go to the smaller one.
    Vector arrive = hn::LoadU(tag, row.before + f - 1);
    Vector advance = hn::Zero(tag);
    for (std::size_t k = 2; k <= steps; ++k) {
      const Vector from = hn::LoadU(tag, row.before + f - k);
      const Mask less = hn::Lt(from, arrive);
      arrive = hn::IfThenElse(less, from, arrive);
      advance = hn::IfThenElse(less, hn::Set(tag, static_cast<double>(k - 1)), advance);
    }
    arrive = hn::Add(arrive, cost);
    // Staying: the longest run first, as each takes the cost of the run before it.
    Vector stay = hn::Add(hn::LoadU(tag, row.held + (holds - 2) * row.held_stride + f), cost);
    Vector run = hn::Set(tag, static_cast<double>(holds - 1));
    for (std::size_t n = holds - 2; n >= 1; --n) {
      const Vector longer = hn::Add(hn::LoadU(tag, row.held + (n - 1) * row.held_stride + f), cost);
      hn::StoreU(longer, tag, row.held + n * row.held_stride + f);
      const Mask no_more = hn::Le(longer, stay);
      stay = hn::IfThenElse(no_more, longer, stay);
      run = hn::IfThenElse(no_more, hn::Set(tag, static_cast<double>(n)), run);
    }
    hn::StoreU(arrive, tag, row.held + f);
    // An advance by 1 wins a tie against staying, staying one against a longer advance.
    const Mask by_one = hn::And(hn::Eq(advance, hn::Zero(tag)), hn::Eq(arrive, stay));
    const Mask arrives = hn::Or(hn::Lt(arrive, stay), by_one);
    hn::StoreU(hn::IfThenElse(arrives, arrive, stay), tag, row.best + f);
    run = hn::IfThenZeroElse(arrives, run);
    const auto code =
        hn::BitCast(wide_tag, hn::ConvertTo(int_tag, hn::Add(advance, hn::Mul(run, hn::Set(tag, shift)))));
    if (row.narrow_codes)
      hn::StoreU(hn::TruncateTo(hn::Rebind<std::uint8_t, Doubles>(), code),
                 hn::Rebind<std::uint8_t, Doubles>(), row.narrow_codes + f);
    else
      hn::StoreU(hn::TruncateTo(hn::Rebind<std::uint32_t, Doubles>(), code),
                 hn::Rebind<std::uint32_t, Doubles>(), row.wide_codes + f);
  }
}

void AdvanceRow(const WarpRow& row) {
  if (row.steps == 3 && row.holds == 3 && row.narrow_codes)
    row_of<3>(row);
  else
    row_of<0>(row);
}

}  // namespace HWY_NAMESPACE
}  // namespace kinegraph
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinegraph {

HWY_EXPORT(SquaredDistances);
HWY_EXPORT(AdvanceRow);

void squared_distances(const double* tiles, std::size_t first_tile, std::size_t last_tile, std::size_t dims,
                       const double* rows, std::size_t row_count, double* out, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(SquaredDistances)(tiles, first_tile, last_tile, dims, rows, row_count, out, stride);
}

void advance_row(const WarpRow& row) {
  HWY_DYNAMIC_DISPATCH(AdvanceRow)(row);
}

}  // namespace kinegraph
#endif
