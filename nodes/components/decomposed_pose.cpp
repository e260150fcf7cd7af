#include "nodes/components/decomposed_pose.h"

#include <algorithm>

#include "nodes/motion/track_kernels.h"

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

Vec3 DecomposedPose::root_place(std::size_t t) const {
  const Skeleton& bones = motion_.skeleton();
  return bones.above_offset + rotate(bones.above, bones.above_scale * motion_.local_offset(0, t));
}

Quat DecomposedPose::root_facing(std::size_t t) const {
  return space_.heading ? about_y(root_.heading[t]) : Quat{};
}

void DecomposedPose::links(int joint, std::size_t begin, Vec3Track out) const {
  const int at = joint_of_[joint];
  const double stretch = stretch_[joint];
  const auto fill = [&](std::span<double> to, std::span<const double> moving, double fixed) {
    if (moving.empty())
      std::fill(to.begin(), to.end(), stretch == 1 ? fixed : stretch * fixed);
    else
      std::transform(moving.begin() + static_cast<std::ptrdiff_t>(begin),
                     moving.begin() + static_cast<std::ptrdiff_t>(begin + to.size()), to.begin(),
                     [&](double x) { return stretch == 1 ? x : stretch * x; });
  };
  const ConstVec3Track moving = at > 0 && motion_.translates(at) ? motion_.translation(at) : ConstVec3Track{};
  const Vec3 fixed = skeleton_.joints[joint].offset;
  fill(out.x, moving.x, fixed.x);
  fill(out.y, moving.y, fixed.y);
  fill(out.z, moving.z, fixed.z);
}

namespace {

ConstQuatTrack part(ConstQuatTrack track, std::size_t begin, std::size_t count) {
  return {track.x.subspan(begin, count), track.y.subspan(begin, count), track.z.subspan(begin, count),
          track.w.subspan(begin, count)};
}

}  // namespace

void rooted_poses(const DecomposedPose& motion, std::size_t begin, std::size_t end, RootedPoses& poses) {
  const Skeleton& skeleton = motion.skeleton();
  const std::size_t joints = skeleton.joints.size(), frames = end - begin;
  if (poses.frames() != frames || poses.local.size() != joints)
    poses = {JointPositions(joints, frames), JointRotations(joints, frames),
             std::vector<ConstQuatTrack>(joints), std::vector<JointRotations>(joints)};
  JointPositions links(1, frames);
  for (int j = 0; j < skeleton.size(); ++j) {
    if (const int at = motion.joint(j); at > 0) {
      poses.local[j] = part(motion.motion().rotation(at), begin, frames);
    } else {
      JointRotations& own = poses.own_local[j];
      if (own.frames() != frames) own = JointRotations(1, frames);
      for (std::size_t t = 0; t < frames; ++t) own[0].set(t, motion.local(j, begin + t));
      poses.local[j] = std::as_const(own)[0];
    }
    const QuatTrack world = poses.world[j];
    const Vec3Track position = poses.positions[j];
    const int parent = skeleton.joints[j].parent;
    if (parent < 0) {
      for (std::size_t t = 0; t < frames; ++t) {
        position.set(t, {});
        world.set(t, poses.local[j][t]);
      }
      continue;
    }
    motion.links(j, begin, links[0]);
    const ConstQuatTrack above = std::as_const(poses.world)[parent];
    hang_tracks(std::as_const(poses.positions)[parent], above, std::as_const(links)[0], position);
    compose_tracks(above, false, poses.local[j], world);
  }
}

}  // namespace kinegraph
