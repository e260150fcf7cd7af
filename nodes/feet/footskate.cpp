#include "nodes/feet/footskate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "graph/diagnostic.h"
#include "nodes/feet/ankle_targets.h"
#include "nodes/feet/floor_clearance.h"
#include "nodes/feet/foot_track.h"
#include "nodes/feet/ground_level.h"
#include "nodes/feet/plant_positions.h"
#include "nodes/feet/root_adjustment.h"
#include "nodes/feet/solved_leg.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

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

double largest_move(const Motion& before, const Motion& after) {
  double largest = 0;
  for (std::size_t t = 0; t < before.frames(); ++t)
    largest = std::max(largest, norm(after.local_offset(0, t) - before.local_offset(0, t)));
  return largest * before.skeleton().above_scale;
}

// Joints from below `top` down to `bottom`.
std::vector<int> links(const Skeleton& skeleton, int top, int bottom) {
  std::vector<int> chain;
  for (int joint = bottom; joint != top && joint >= 0; joint = skeleton.joints[joint].parent)
    chain.push_back(joint);
  return chain;
}

// A motion's feet, and where they have to go.
struct Feet {
  WorldMotion world;
  std::vector<FootTrack> tracks;
  std::vector<FloorLimits> floors;
  std::vector<AnkleTargets> targets;
  std::vector<std::vector<double>> lifts;  // PlantPositions::lift
  std::vector<Vec3> root;                  // by how much the root moves for them
};
Feet feet_of(const Motion& motion, const Contacts& contacts, const FootskateParams& params,
             const std::vector<double>& weights, Work& work) {
  Feet feet{world_motion(motion, work), {}, {}, {}, {}, {}};
  feet.tracks = foot_tracks(motion.skeleton(), feet.world, contacts);
  const double fps = motion.fps();
  for (const FootTrack& foot : feet.tracks) {
    work.check();
    const PlantPositions places = plant_positions(foot, fps, params.floor, contacts.floor);
    feet.floors.push_back(floor_limits(contacts, foot, params.floor));
    AnkleTargets target = ankle_turns(foot, places, fps, params.blend);
    raise_heels(foot, places, feet.floors.back(), fps, params.blend, target);
    move_ankles(foot, places, fps, params.blend, target);
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      target.move[t] *= weights[t];
      if (weights[t] != 1) target.turn[t] = slerp(weights[t], Quat{}, target.turn[t]);
    }
    feet.targets.push_back(std::move(target));
    feet.lifts.push_back(places.lift);
  }
  feet.root = root_adjustment(feet.world, feet.tracks, feet.targets, fps,
                              {params.root_smoothing, params.knee_damping / degrees_per_radian}, work);
  return feet;
}

}  // namespace

FootskateResult clean_footskate(const Motion& input, const Contacts& contacts, const FootskateParams& params,
                                const std::vector<double>& weights, Work& work) {
  Motion motion = input.translates(0) ? input : input.with_translation(0);
  const Skeleton& skeleton = input.skeleton();
  Feet all = feet_of(motion, contacts, params, weights, work);
  work.progress(0.3);
  if (const auto rise = rise_to_ground(all.targets, all.lifts, all.root, motion.fps()); !rise.empty()) {
    std::vector<Vec3> moves(motion.frames());
    for (std::size_t t = 0; t < moves.size(); ++t) moves[t] = {0, weights[t] * rise[t], 0};
    move_root(skeleton, moves, motion);
    all = feet_of(motion, contacts, params, weights, work);
  }
  const WorldMotion& world = all.world;
  const std::vector<FootTrack>& feet = all.tracks;
  std::vector<AnkleTargets>& targets = all.targets;
  const double damping = params.knee_damping / degrees_per_radian;
  work.progress(0.6);

  FootskateResult result;
  result.motion = motion;
  move_root(skeleton, all.root, result.motion);
  result.largest_root_move = largest_move(input, result.motion);
  // First all rotations: most motions need no more tracks than they have.
  std::vector<SolvedLeg> legs;
  for (std::size_t f = 0; f < feet.size(); ++f) {
    AnkleTargets& target = targets[f];
    // Only now: a body that swings its feet too low isn't lifted for it.
    lift_off_floor(feet[f], all.floors[f], motion.fps(), params.blend, weights, target);
    const Leg& leg = feet[f].leg;
    legs.push_back(solved_leg(world, feet[f], target, all.root, {params.stretch, damping}, motion.fps(),
                              std::min(params.blend, stretch_blend), work));
    target.move = legs[f].ankle_move;
    raise_balls(feet[f], all.floors[f], motion.fps(), params.blend, weights, target);
    const std::vector<Quat> toes = toe_turns(feet[f], all.floors[f], motion.fps(), params.blend, target);
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      if (t % 256 == 0) work.check();
      const double residual = legs[f].residual[t];
      if (target.held[t] && weights[t] == 1 && residual > result.largest_residual) {
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
      const Quat thigh = legs[f].thigh[t], shank = legs[f].shank[t];
      set(leg.hip, Quat{}, thigh);
      set(leg.knee, thigh, shank);
      set(leg.ankle, shank, target.turn[t]);
      if (!toes.empty()) set(leg.toe, target.turn[t], slerp(weights[t], Quat{}, toes[t]) * target.turn[t]);
    }
  }
  work.progress(0.9);
  for (std::size_t f = 0; f < feet.size(); ++f) {
    const std::vector<Vec3>& stretch = legs[f].stretch;
    double largest = 0;
    for (const Vec3& part : stretch) largest = std::max(largest, std::abs(part.x));
    if (largest == 0) continue;
    result.largest_stretch = std::max(result.largest_stretch, largest);
    for (int joint : links(skeleton, feet[f].leg.hip, feet[f].leg.ankle)) {
      if (!result.motion.translates(joint)) result.motion = result.motion.with_translation(joint);
      const Vec3Track track = result.motion.translation(joint);
      for (std::size_t t = 0; t < motion.frames(); ++t) track.set(t, (1 + stretch[t].x) * track[t]);
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
