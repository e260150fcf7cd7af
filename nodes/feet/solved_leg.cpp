#include "nodes/feet/solved_leg.h"

#include <algorithm>
#include <cmath>

#include "nodes/feet/blending.h"
#include "nodes/feet/leg_solver.h"

namespace kinegraph {
namespace {

constexpr double largest_carried_stretch = 0.1;  // of the leg's length

}  // namespace

SolvedLeg solved_leg(const WorldMotion& world, const FootTrack& foot, const AnkleTargets& targets,
                     const std::vector<Vec3>& root, const LegLimits& limits, double fps, double fade,
                     Work& work) {
  const std::size_t frames = foot.frames();
  SolvedLeg leg;
  leg.thigh.resize(frames);
  leg.shank.resize(frames);
  leg.stretch.resize(frames);
  leg.ankle_move.resize(frames);
  leg.residual.resize(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    if (t % 256 == 0) work.check();
    const Vec3 hip = world.position(foot.leg.hip)[t], knee = world.position(foot.leg.knee)[t];
    const Vec3 ankle = foot.ankle[t], target = ankle + targets.move[t];
    const LegChange change = solve_leg(hip, knee, ankle, hip + root[t], target, limits.damping);
    leg.thigh[t] = change.thigh;
    leg.shank[t] = change.shank;
    leg.stretch[t] = {std::clamp(change.stretch, 1 - limits.stretch, 1 + limits.stretch) - 1, 0, 0};
    leg.residual[t] = std::abs(1 - (1 + leg.stretch[t].x) / change.stretch) * norm(target - hip - root[t]);
  }
  fill_smoothly(leg.stretch, targets.held, fps, fade, largest_carried_stretch);
  for (std::size_t t = 0; t < frames; ++t) {
    const Vec3 hip = world.position(foot.leg.hip)[t], knee = world.position(foot.leg.knee)[t];
    const Vec3 limb = rotate(leg.thigh[t], knee - hip) + rotate(leg.shank[t], foot.ankle[t] - knee);
    leg.ankle_move[t] = hip + root[t] + (1 + leg.stretch[t].x) * limb - foot.ankle[t];
  }
  return leg;
}

}  // namespace kinegraph
