#include "nodes/feet/root_adjustment.h"

#include "nodes/feet/banded_system.h"

namespace kinegraph {

std::vector<Vec3> root_adjustment(const WorldMotion& world, const std::vector<FootTrack>& feet,
                                  const std::vector<AnkleTargets>& targets, double fps, double smoothing) {
  constexpr double planted = 1, swinging = 0.15;  // weights of the legs' lengths
  constexpr double least = 0.02;                  // of not moving at all
  const std::size_t frames = world.frames();
  BandedSystem system(3 * frames, 6);
  std::vector<double> right(3 * frames, 0.0);
  for (std::size_t t = 0; t < frames; ++t) {
    for (std::size_t axis = 0; axis < 3; ++axis) system.add(3 * t + axis, 3 * t + axis, least);
    for (std::size_t f = 0; f < feet.size(); ++f) {
      const Vec3 along = normalized(feet[f].ankle[t] - world.position(feet[f].leg.hip)[t]);
      const double weight = targets[f].held[t] ? planted : swinging;
      const double wanted = weight * dot(along, targets[f].move[t]);
      for (int a = 0; a < 3; ++a) {
        right[3 * t + a] += wanted * along[a];
        for (int b = 0; b <= a; ++b) system.add(3 * t + a, 3 * t + b, weight * along[a] * along[b]);
      }
    }
  }
  const double frames_long = smoothing * fps;
  const double stiff = frames_long * frames_long * frames_long * frames_long;
  static constexpr double difference[3] = {1, -2, 1};
  for (std::size_t t = 0; t + 2 < frames; ++t)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b <= a; ++b)
        for (std::size_t axis = 0; axis < 3; ++axis)
          system.add(3 * (t + a) + axis, 3 * (t + b) + axis, stiff * difference[a] * difference[b]);
  system.factor();
  system.solve(right);
  std::vector<Vec3> moves(frames);
  for (std::size_t t = 0; t < frames; ++t) moves[t] = {right[3 * t], right[3 * t + 1], right[3 * t + 2]};
  return moves;
}

}  // namespace kinegraph
