#include "nodes/components/decomposed_pose.h"

namespace kinegraph {

DecomposedPose::DecomposedPose(const ChannelSpace& space, const Motion& motion, Work& work)
    : space_(space),
      motion_(motion),
      root_(encode_root(motion, work)),
      joint_of_(joints_of(space, motion.skeleton())),
      skeleton_(*space.skeleton),
      stretch_(space.skeleton->joints.size(), 1) {
  for (int j = 1; j < skeleton_.size(); ++j) {
    const int at = joint_of_[j];
    if (at > 0 && norm(motion.skeleton().joints[at].offset) > 1e-9)
      skeleton_.joints[j].offset = motion.skeleton().joints[at].offset;
    const double own = norm(skeleton_.joints[j].offset), wanted = space.skeleton->link_length(j);
    if (own > 1e-9 && own != wanted) stretch_[j] = wanted / own;
  }
}

Quat DecomposedPose::local(int joint, std::size_t t) const {
  const int at = joint_of_[joint];
  if (at < 0) return space_.skeleton->joints[joint].rest;
  if (at > 0) return motion_.rotation(at)[t];
  return space_.heading ? root_.rho[t] : about_y(root_.heading[t]) * root_.rho[t];
}

Vec3 DecomposedPose::link(int joint, std::size_t t) const {
  const int at = joint_of_[joint];
  const Vec3 offset =
      at > 0 && motion_.translates(at) ? motion_.local_offset(at, t) : skeleton_.joints[joint].offset;
  return stretch_[joint] == 1 ? offset : stretch_[joint] * offset;
}

void rooted_pose(const DecomposedPose& motion, std::size_t t, RootedPose& pose) {
  const Skeleton& skeleton = motion.skeleton();
  const std::size_t n = skeleton.joints.size();
  pose.positions.resize(n);
  pose.world.resize(n);
  pose.local.resize(n);
  for (int j = 0; j < skeleton.size(); ++j) {
    pose.local[j] = motion.local(j, t);
    const int parent = skeleton.joints[j].parent;
    if (parent < 0) {
      pose.positions[j] = {};
      pose.world[j] = pose.local[j];
    } else {
      pose.positions[j] = pose.positions[parent] + rotate(pose.world[parent], motion.link(j, t));
      pose.world[j] = pose.world[parent] * pose.local[j];
    }
  }
}

}  // namespace kinegraph
