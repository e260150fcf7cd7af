#include "nodes/feet/footskate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "graph/diagnostic.h"
#include "nodes/feet/ankle_targets.h"
#include "nodes/feet/blending.h"
#include "nodes/feet/floor_clearance.h"
#include "nodes/feet/foot_track.h"
#include "nodes/feet/leg_solver.h"
#include "nodes/feet/plant_positions.h"
#include "nodes/feet/root_adjustment.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr double largest_carried_stretch = 0.1;  // of the leg's length
constexpr double stretch_blend = 0.06;  // s; longer ones would carry a stretch that grows at a plant's end on

// World orientation of what stands above a joint.
Quat above(const Skeleton& skeleton, const WorldMotion& world, int joint, std::size_t t) {
  const int parent = skeleton.joints[joint].parent;
  return parent < 0 ? skeleton.above : world.orientation(parent)[t];
}

void move_root(const Skeleton& skeleton, const std::vector<Vec3>& moves, Motion& motion) {
  const Vec3Track root = motion.translation(0);
  for (std::size_t t = 0; t < motion.frames(); ++t)
    root.set(t, root[t] + rotate(inverse(skeleton.above), moves[t]) / skeleton.above_scale);
}

// Joints from below `top` down to `bottom`.
std::vector<int> links(const Skeleton& skeleton, int top, int bottom) {
  std::vector<int> chain;
  for (int joint = bottom; joint != top && joint >= 0; joint = skeleton.joints[joint].parent)
    chain.push_back(joint);
  return chain;
}

}  // namespace

FootskateResult clean_footskate(const Motion& motion, const Contacts& contacts, const FootskateParams& params,
                                const std::vector<double>& weights, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  const WorldMotion world = world_motion(motion, work);
  const std::vector<FootTrack> feet = foot_tracks(skeleton, world, contacts);
  const FloorLimits floor = floor_limits(contacts, params.floor);
  std::vector<AnkleTargets> targets;
  std::vector<std::vector<Quat>> toes;
  for (const FootTrack& foot : feet) {
    work.check();
    const PlantPositions places = plant_positions(foot, motion.fps(), params.floor, contacts.floor);
    AnkleTargets target = ankle_targets(foot, places, motion.fps(), params.blend);
    lift_off_floor(foot, floor, motion.fps(), params.blend, target);
    std::vector<Quat> toe = toe_turns(foot, floor, motion.fps(), params.blend, target);
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      target.move[t] *= weights[t];
      if (!toe.empty() && weights[t] != 1) toe[t] = slerp(weights[t], Quat{}, toe[t]);
      if (weights[t] != 1) target.turn[t] = slerp(weights[t], Quat{}, target.turn[t]);
    }
    targets.push_back(std::move(target));
    toes.push_back(std::move(toe));
  }
  work.progress(0.3);
  const double damping = params.knee_damping / degrees_per_radian;
  const std::vector<Vec3> root =
      root_adjustment(world, feet, targets, motion.fps(), {params.root_smoothing, damping}, work);
  work.progress(0.6);

  FootskateResult result;
  for (const Vec3& move : root) result.largest_root_move = std::max(result.largest_root_move, norm(move));
  // First all rotations, with each leg's stretch kept aside: most motions need no more tracks than they have.
  result.motion = motion.translates(0) ? motion : motion.with_translation(0);
  move_root(skeleton, root, result.motion);
  std::vector<std::vector<Vec3>> stretches(feet.size(), std::vector<Vec3>(motion.frames()));
  for (std::size_t f = 0; f < feet.size(); ++f) {
    const Leg& leg = feet[f].leg;
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      if (t % 256 == 0) work.check();
      const Vec3 hip = world.position(leg.hip)[t], knee = world.position(leg.knee)[t],
                 ankle = feet[f].ankle[t];
      const LegChange change =
          solve_leg(hip, knee, ankle, hip + root[t], ankle + targets[f].move[t], damping);
      const double most = params.stretch;
      stretches[f][t] = {std::clamp(change.stretch, 1 - most, 1 + most) - 1, 0, 0};
      const double wanted = norm(ankle + targets[f].move[t] - hip - root[t]);
      const double residual = std::abs(1 - (1 + stretches[f][t].x) / change.stretch) * wanted;
      if (targets[f].held[t] && weights[t] == 1 && residual > result.largest_residual) {
        result.largest_residual = residual;
        result.residual_frame = t;
        result.residual_joint = leg.ankle;
      }
      // World orientations X·R; a joint's new local rotation is (X_above R_above)⁻¹ (X R).
      const auto set = [&](int joint, Quat of_above, Quat of_joint) {
        const Quat local =
            inverse(of_above * above(skeleton, world, joint, t)) * of_joint * world.orientation(joint)[t];
        result.motion.rotation(joint).set(t, normalized(nearer(local, motion.rotation(joint)[t])));
      };
      set(leg.hip, Quat{}, change.thigh);
      set(leg.knee, change.thigh, change.shank);
      set(leg.ankle, change.shank, targets[f].turn[t]);
      if (!toes[f].empty()) set(leg.toe, targets[f].turn[t], toes[f][t] * targets[f].turn[t]);
    }
  }
  work.progress(0.9);
  for (std::size_t f = 0; f < feet.size(); ++f) {
    // A swinging foot has no place to meet: its leg goes back to its length.
    fill_smoothly(stretches[f], targets[f].held, motion.fps(), std::min(params.blend, stretch_blend),
                  largest_carried_stretch);
    double largest = 0;
    for (const Vec3& stretch : stretches[f]) largest = std::max(largest, std::abs(stretch.x));
    if (largest == 0) continue;
    result.largest_stretch = std::max(result.largest_stretch, largest);
    for (int joint : links(skeleton, feet[f].leg.hip, feet[f].leg.ankle)) {
      if (!result.motion.translates(joint)) result.motion = result.motion.with_translation(joint);
      const Vec3Track track = result.motion.translation(joint);
      for (std::size_t t = 0; t < motion.frames(); ++t) track.set(t, (1 + stretches[f][t].x) * track[t]);
    }
  }
  if (result.largest_residual > 0.001) {
    work.report(warning("plants-out-of-reach", fmt::format("a planted foot stays {:.1f} mm from its place",
                                                           1000 * result.largest_residual))
                    .at_joint(skeleton.joints[result.residual_joint].name)
                    .at_frame(static_cast<std::int64_t>(result.residual_frame))
                    .hinting("allow more stretch, or less root_smoothing"));
  }
  return result;
}

}  // namespace kinegraph
