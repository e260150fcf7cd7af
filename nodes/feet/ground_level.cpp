#include "nodes/feet/ground_level.h"

#include <algorithm>
#include <cmath>

#include "nodes/feet/banded_system.h"

namespace kinegraph {
namespace {

constexpr double smoothing = 0.4;    // s
constexpr double least_rise = 1e-4;  // m
constexpr double knees_take = 0.02;  // m
constexpr double evenness = 1e-6;    // of the first difference: one stand alone gives no slope

}  // namespace

std::vector<double> rise_to_ground(const std::vector<FootTrack>& feet,
                                   const std::vector<PlantPositions>& places, double fps) {
  const std::size_t frames = feet.empty() ? 0 : feet[0].frames();
  BandedSystem system(frames, 2);
  std::vector<double> rise(frames, 0.0);
  double largest = 0;
  for (std::size_t f = 0; f < feet.size(); ++f) {
    for (std::size_t t = 0; t < frames; ++t) {
      if (!feet[f].heel.planted_at(t) && !feet[f].ball.planted_at(t)) continue;
      largest = std::max(largest, std::fabs(places[f].lift[t]));
      system.add(t, t, 1);
      rise[t] += places[f].lift[t];
    }
  }
  if (largest < least_rise) return {};
  const double reach = smoothing * fps, stiff = reach * reach * reach * reach;
  static constexpr double difference[3] = {1, -2, 1};
  for (std::size_t t = 0; t + 1 < frames; ++t) {
    system.add(t, t, evenness);
    system.add(t + 1, t + 1, evenness);
    system.add(t + 1, t, -evenness);
  }
  for (std::size_t t = 0; t + 2 < frames; ++t)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b <= a; ++b) system.add(t + a, t + b, stiff * difference[a] * difference[b]);
  system.factor();
  system.solve(rise);
  for (double& height : rise) height = height > 0 ? height * height / (height + knees_take) : 0;
  return rise;
}

}  // namespace kinegraph
