#include "nodes/feet/ground_level.h"

#include <algorithm>
#include <cmath>

#include "nodes/feet/banded_system.h"

namespace kinegraph {
namespace {

constexpr double smoothing = 0.4;    // s
constexpr double least_rise = 1e-3;  // m
constexpr double of_steps = 0.02;    // m

}  // namespace

std::vector<double> rise_to_ground(const std::vector<AnkleTargets>& targets,
                                   const std::vector<std::vector<double>>& lifts,
                                   const std::vector<Vec3>& root, double fps) {
  const std::size_t frames = root.size();
  BandedSystem system(frames, 2);
  std::vector<double> rise(frames, 0.0);
  double largest = 0;
  std::size_t first = frames, last = 0;
  for (std::size_t f = 0; f < targets.size(); ++f) {
    for (std::size_t t = 0; t < frames; ++t) {
      if (!targets[f].held[t]) continue;
      first = std::min(first, t);
      last = std::max(last, t);
      const double asked = lifts[f][t] > 0 ? lifts[f][t] : std::min(root[t].y, 0.0);
      largest = std::max(largest, std::fabs(asked));
      system.add(t, t, 1);
      rise[t] += asked;
    }
  }
  if (largest < least_rise) return {};
  const double reach = smoothing * fps, stiff = reach * reach * reach * reach;
  static constexpr double difference[3] = {1, -2, 1};
  for (std::size_t t = 0; t + 1 < frames; ++t) {
    // Of the first difference: one stand alone gives no slope.
    const double level = t < first || t >= last ? stiff : 1e-6;
    system.add(t, t, level);
    system.add(t + 1, t + 1, level);
    system.add(t + 1, t, -level);
  }
  for (std::size_t t = 0; t + 2 < frames; ++t)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b <= a; ++b) system.add(t + a, t + b, stiff * difference[a] * difference[b]);
  system.factor();
  system.solve(rise);
  for (double& height : rise) height *= std::fabs(height) / (std::fabs(height) + of_steps);
  return rise;
}

}  // namespace kinegraph
