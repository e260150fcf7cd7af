#include "nodes/motion/moving_root.h"

#include <algorithm>

#include "nodes/motion/encoded_root.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

namespace {

bool stands_still(const Motion& motion) {
  const auto rotation = motion.rotation(0);
  for (std::size_t t = 1; t < motion.frames(); ++t)
    if (turn(rotation[0], rotation[t]) > 1e-6 ||
        norm(motion.local_offset(0, t) - motion.local_offset(0, 0)) > 1e-6)
      return false;
  return motion.frames() > 0;
}

bool moves(const Motion& motion, int joint) {
  if (!motion.translates(joint)) return false;
  for (std::size_t t = 1; t < motion.frames(); ++t)
    if (norm(motion.translation(joint)[t] - motion.translation(joint)[0]) > 1e-6) return true;
  return false;
}

// -1: none.
int carrier_of(const Motion& motion) {
  for (int joint = 1; joint < motion.joints(); ++joint)  // parents come first
    if (moves(motion, joint) && carries_the_legs(motion.skeleton(), joint)) return joint;
  return -1;
}

// The carrier alone, as a root in the world: what its heading is asked of.
Motion alone(const WorldMotion& world, int carrier, Quat rest, double fps) {
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {{"carrier", -1, {}, rest}};
  Motion motion(skeleton, std::make_shared<SourceFacts>(), fps, world.frames(), {true});
  for (std::size_t t = 0; t < world.frames(); ++t) {
    motion.rotation(0).set(t, world.orientation(carrier)[t]);
    motion.translation(0).set(t, world.position(carrier)[t]);
  }
  return motion;
}

std::shared_ptr<const Motion> carried_by(const std::shared_ptr<const Motion>& motion, int carrier,
                                         Work& work) {
  const Skeleton& skeleton = motion->skeleton();
  const WorldMotion world = world_motion(*motion, work);
  const Quat rest = rest_pose(skeleton).orientations[static_cast<std::size_t>(carrier)];
  const EncodedRoot way = encode_root(alone(world, carrier, rest, motion->fps()), work);

  Motion out = motion->translates(0) ? *motion : motion->with_translation(0);
  out.set_source(without_read(motion->shared_source()));
  const Quat rest_of_root = skeleton.above * skeleton.joints[0].rest;
  for (std::size_t t = 0; t < out.frames(); ++t) {
    out.rotation(0).set(t, inverse(skeleton.above) * about_y(way.heading[t]) * rest_of_root);
    const Vec3 place = world.position(carrier)[t] - skeleton.above_offset;
    out.translation(0).set(t, rotate(inverse(skeleton.above), place) / skeleton.above_scale);
  }
  // Everything that hangs on the root stays where it was.
  for (int joint : skeleton.children(0)) {
    if (!out.translates(joint)) out = out.with_translation(joint);
    for (std::size_t t = 0; t < out.frames(); ++t) {
      const Quat up = inverse(skeleton.above * out.rotation(0)[t]);
      out.rotation(joint).set(t, up * world.orientation(joint)[t]);
      out.translation(joint).set(
          t, rotate(up, world.position(joint)[t] - world.position(carrier)[t]) / skeleton.above_scale);
    }
    const auto track = out.rotation(joint);
    make_continuous(track.x, track.y, track.z, track.w);
  }
  const auto track = out.rotation(0);
  make_continuous(track.x, track.y, track.z, track.w);
  return std::make_shared<const Motion>(std::move(out));
}

}  // namespace

bool carries_the_legs(const Skeleton& skeleton, int joint) {
  const auto legs = find_legs(skeleton);
  return joint > 0 && legs.size() == 2 && std::all_of(legs.begin(), legs.end(), [&](const Leg& leg) {
           return skeleton.is_below(leg.hip, joint);
         });
}

std::shared_ptr<const Motion> with_moving_root(std::shared_ptr<const Motion> motion, Work& work) {
  return with_moving_roots({std::move(motion)}, work).front();
}

std::vector<std::shared_ptr<const Motion>> with_moving_roots(
    std::vector<std::shared_ptr<const Motion>> motions, Work& work) {
  std::vector<bool> still;
  std::string carrier;
  for (const auto& motion : motions) {
    still.push_back(stands_still(*motion));
    if (!still.back() || !carrier.empty()) continue;
    if (const int joint = carrier_of(*motion); joint > 0)
      carrier = motion->skeleton().joints[static_cast<std::size_t>(joint)].name;
  }
  for (std::size_t i = 0; i < motions.size() && !carrier.empty(); ++i)
    if (const int joint = motions[i]->skeleton().find(carrier); still[i] && joint > 0)
      motions[i] = carried_by(motions[i], joint, work);
  return motions;
}

}  // namespace kinegraph
