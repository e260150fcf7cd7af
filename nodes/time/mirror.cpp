#include "nodes/time/mirror.h"

#include "nodes/motion/kinematics.h"

namespace kinegraph {

Motion mirrored(const Motion& motion, const Sides& sides, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  RestPose rest = rest_pose(skeleton);
  std::size_t frames = motion.frames();
  auto translates = motion.translating();
  for (int j = 0; j < motion.joints(); ++j)
    if (motion.translates(j)) translates[sides.partner[j]] = true;
  if (!translates.empty()) translates[0] = true;  // a reflected place, even where it never moves
  Motion result(motion.shared_skeleton(), without_read(motion.shared_source()), motion.fps(), frames,
                translates);
  WorldMotion world = world_motion(motion, work);

  // World orientations of the result, joint after joint, as parents come first.
  std::vector<std::vector<Quat>> turned(skeleton.joints.size(), std::vector<Quat>(frames));
  for (int j = 0; j < motion.joints(); ++j) {
    work.check();
    int source = sides.partner[j], parent = skeleton.joints[j].parent;
    auto from = world.orientation(source);
    auto to = result.rotation(j);
    Quat from_rest = inverse(rest.orientations[source]);
    Quat to_rest = sides.frames[j] * rest.orientations[j];
    for (std::size_t t = 0; t < frames; ++t) {
      turned[j][t] = reflected(from[t] * from_rest, sides.across) * to_rest;
      to.set(t, normalized(inverse(parent < 0 ? skeleton.above : turned[parent][t]) * turned[j][t]));
    }
    make_continuous(to.x, to.y, to.z, to.w);
    if (!translates[j]) continue;
    auto place = result.translation(j);
    if (parent < 0) {
      for (std::size_t t = 0; t < frames; ++t) {
        Vec3 p = reflected(world.position(source)[t], sides.across);
        place.set(t, rotate(inverse(skeleton.above), p - skeleton.above_offset) / skeleton.above_scale);
      }
      continue;
    }
    // What the partner moved away from its offset, at rest in world, is what this one moves, reflected.
    int source_parent = skeleton.joints[source].parent;
    Quat to_world = source_parent < 0 ? skeleton.above : rest.orientations[source_parent];
    Quat to_local = inverse(sides.frames[parent] * rest.orientations[parent]);
    for (std::size_t t = 0; t < frames; ++t) {
      Vec3 moved = motion.local_offset(source, t) - skeleton.joints[source].offset;
      place.set(
          t, skeleton.joints[j].offset + rotate(to_local, reflected(rotate(to_world, moved), sides.across)));
    }
  }
  return result;
}

}  // namespace kinegraph
