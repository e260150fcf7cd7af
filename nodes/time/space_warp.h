// The space warp of iterative motion warping: a scale a and an offset b at every frame of the warped series
// [Wu eq. 1, 3].
//
// Given the path W, minimises for one dimension
//   ‖W(S a + b) − r‖² + ‖F a‖² + ‖G b‖² + ε(‖a − 1‖² + ‖b‖²),   F, G: weight × (x_{i+1} − x_i), N − 1 rows.
// Printed eq. 1 has a stray third term ‖F b‖². First differences leave constants free, hence the small ridge
// ε.
#pragma once
#include <cstdint>
#include <span>

namespace kinegraph {

struct SpaceWarpWeights {
  double scale_smoothness = 0;   // of F
  double offset_smoothness = 0;  // of G
  double ridge = 0;              // ε
};

// The energy above; each part is summed along time.
double space_warp_energy(std::span<const double> s, std::span<const double> r,
                         std::span<const std::uint32_t> path, const SpaceWarpWeights& weights,
                         std::span<const double> a, std::span<const double> b);

// Moves a and b to the minimum, in time linear in the frames: WᵀW is diagonal (how many rows show each
// frame), so with a and b interleaved eq. 3 is block tridiagonal in 2×2 blocks. It is solved for the change
// from the present a and b, so that rounding is relative to the change and not to the solution. Keeps a and b
// where that does not lower the energy. Returns the largest |change|.
double solve_space_warp(std::span<const double> s, std::span<const double> r,
                        std::span<const std::uint32_t> path, const SpaceWarpWeights& weights,
                        std::span<double> a, std::span<double> b);

}  // namespace kinegraph
