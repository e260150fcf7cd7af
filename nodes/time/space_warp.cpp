#include "nodes/time/space_warp.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kinegraph {
namespace {

double squared_differences(std::span<const double> x) {
  double sum = 0;
  for (std::size_t i = 1; i < x.size(); ++i) sum += (x[i] - x[i - 1]) * (x[i] - x[i - 1]);
  return sum;
}

struct Pair {
  double a = 0, b = 0;
};
// [[aa, ab], [ab, bb]]
struct Symmetric {
  double aa = 0, ab = 0, bb = 0;
  Symmetric inverse() const {
    const double determinant = aa * bb - ab * ab;
    return {bb / determinant, -ab / determinant, aa / determinant};
  }
  Pair operator*(Pair v) const { return {aa * v.a + ab * v.b, ab * v.a + bb * v.b}; }
};

// What eliminating a block E + L leaves of L in the next one: L − L (E + L)⁻¹ L, with L = diag(ff, gg),
// written without its cancellation.
Symmetric passed_on(const Symmetric& e, double ff, double gg) {
  const double own = std::max(0.0, e.aa * e.bb - e.ab * e.ab);
  const double whole = own + e.aa * gg + e.bb * ff + ff * gg;
  if (!(whole > 0)) return {};
  return {ff * (own + e.aa * gg) / whole, ff * gg * e.ab / whole, gg * (own + e.bb * ff) / whole};
}

}  // namespace

double space_warp_energy(std::span<const double> s, std::span<const double> r,
                         std::span<const std::uint32_t> path, const SpaceWarpWeights& weights,
                         std::span<const double> a, std::span<const double> b) {
  double misses = 0;
  for (std::size_t row = 0; row < path.size(); ++row) {
    const std::size_t i = path[row];
    const double miss = s[i] * a[i] + b[i] - r[row];
    misses += miss * miss;
  }
  double from_start = 0;
  for (std::size_t i = 0; i < a.size(); ++i) from_start += (a[i] - 1) * (a[i] - 1) + b[i] * b[i];
  return misses + weights.scale_smoothness * weights.scale_smoothness * squared_differences(a) +
         weights.offset_smoothness * weights.offset_smoothness * squared_differences(b) +
         weights.ridge * from_start;
}

double solve_space_warp(std::span<const double> s, std::span<const double> r,
                        std::span<const std::uint32_t> path, const SpaceWarpWeights& weights,
                        std::span<double> a, std::span<double> b) {
  const std::size_t count = a.size();
  const double ff = weights.scale_smoothness * weights.scale_smoothness;
  const double gg = weights.offset_smoothness * weights.offset_smoothness;

  // Minus half the gradient at the present a, b.
  std::vector<Pair> right(count);
  std::vector<double> hits(count, 0.0), missing(count, 0.0);
  for (std::size_t row = 0; row < path.size(); ++row) {
    const std::size_t i = path[row];
    hits[i] += 1;
    missing[i] += r[row] - (s[i] * a[i] + b[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double bend_a = (i > 0 ? a[i] - a[i - 1] : 0) + (i + 1 < count ? a[i] - a[i + 1] : 0);
    const double bend_b = (i > 0 ? b[i] - b[i - 1] : 0) + (i + 1 < count ? b[i] - b[i + 1] : 0);
    right[i] = {s[i] * missing[i] - ff * bend_a - weights.ridge * (a[i] - 1),
                missing[i] - gg * bend_b - weights.ridge * b[i]};
  }

  // Block elimination of eq. 3's matrix; the blocks beside its diagonal are −L = −diag(ff, gg).
  std::vector<Symmetric> inverse(count);
  Symmetric excess;  // the eliminated diagonal block without the L that the next frame adds
  for (std::size_t i = 0; i < count; ++i) {
    excess.aa += hits[i] * s[i] * s[i] + weights.ridge;
    excess.ab += hits[i] * s[i];
    excess.bb += hits[i] + weights.ridge;
    const bool last = i + 1 == count;
    inverse[i] = Symmetric{excess.aa + (last ? 0 : ff), excess.ab, excess.bb + (last ? 0 : gg)}.inverse();
    if (last) break;
    const Pair carried = inverse[i] * right[i];
    right[i + 1].a += ff * carried.a;
    right[i + 1].b += gg * carried.b;
    excess = passed_on(excess, ff, gg);
  }
  std::vector<double> next_a(a.begin(), a.end()), next_b(b.begin(), b.end());
  double largest = 0;
  Pair later;
  for (std::size_t i = count; i-- > 0;) {
    const Pair change = inverse[i] * Pair{right[i].a + ff * later.a, right[i].b + gg * later.b};
    next_a[i] += change.a;
    next_b[i] += change.b;
    largest = std::max({largest, std::abs(change.a), std::abs(change.b)});
    later = change;
  }

  if (!(space_warp_energy(s, r, path, weights, next_a, next_b) <
        space_warp_energy(s, r, path, weights, a, b)))
    return 0;
  std::copy(next_a.begin(), next_a.end(), a.begin());
  std::copy(next_b.begin(), next_b.end(), b.begin());
  return largest;
}

}  // namespace kinegraph
