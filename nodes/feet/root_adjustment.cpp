#include "nodes/feet/root_adjustment.h"

#include "nodes/feet/banded_system.h"
#include "nodes/feet/leg_solver.h"

namespace kinegraph {
namespace {

constexpr double planted = 1, swinging = 0.15;  // weights of the legs' lengths
constexpr double least = 0.02;                  // of not moving at all
constexpr double visible = 0.02;                // a stretch of this part of the leg counts twice
constexpr int rounds = 4;

// What one leg asks of the root: Σ w (pull · r − length)².
struct Demand {
  Vec3 pull;
  double length = 0, weight = 0;
};

// Linear about where the root is.
Demand demand_of(const WorldMotion& world, const FootTrack& foot, const AnkleTargets& target, Vec3 root,
                 double damping, std::size_t t) {
  const Vec3 hip = world.position(foot.leg.hip)[t], knee = world.position(foot.leg.knee)[t];
  const LegReach reach =
      leg_reach(hip, knee, foot.ankle[t], hip + root, foot.ankle[t] + target.move[t], damping);
  Demand demand;
  if (reach.wanted <= 0) return demand;
  const double missing = reach.wanted - reach.bent;
  demand.pull = reach.left_over * reach.along;
  demand.length = missing + dot(demand.pull, root);
  const double seen = missing / (visible * reach.length);
  demand.weight = target.held[t] ? planted * (1 + seen * seen) : swinging;
  return demand;
}

std::vector<Vec3> smallest_moves(const std::vector<std::vector<Demand>>& demands, std::size_t frames,
                                 double frames_long) {
  BandedSystem system(3 * frames, 6);
  std::vector<double> right(3 * frames, 0.0);
  for (std::size_t t = 0; t < frames; ++t) {
    for (std::size_t axis = 0; axis < 3; ++axis) system.add(3 * t + axis, 3 * t + axis, least);
    for (const std::vector<Demand>& leg : demands) {
      const Demand& demand = leg[t];
      for (int a = 0; a < 3; ++a) {
        right[3 * t + a] += demand.weight * demand.length * demand.pull[a];
        for (int b = 0; b <= a; ++b)
          system.add(3 * t + a, 3 * t + b, demand.weight * demand.pull[a] * demand.pull[b]);
      }
    }
  }
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

}  // namespace

std::vector<Vec3> root_adjustment(const WorldMotion& world, const std::vector<FootTrack>& feet,
                                  const std::vector<AnkleTargets>& targets, double fps,
                                  const RootAdjustmentParams& params, Work& work) {
  const std::size_t frames = world.frames();
  std::vector<Vec3> moves(frames);
  std::vector<std::vector<Demand>> demands(feet.size(), std::vector<Demand>(frames));
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t f = 0; f < feet.size(); ++f) {
      for (std::size_t t = 0; t < frames; ++t) {
        if (t % 256 == 0) work.check();
        demands[f][t] = demand_of(world, feet[f], targets[f], moves[t], params.knee_damping, t);
      }
    }
    moves = smallest_moves(demands, frames, params.smoothing * fps);
  }
  return moves;
}

}  // namespace kinegraph
