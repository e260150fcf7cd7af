// A motion in the frame in which it is decomposed: the root at the origin and, with `heading`, R_y(-ψ) taken
// out; the joints of the space's skeleton, with its bone lengths and the motion's own directions.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/components/channels.h"
#include "nodes/components/joint_tracks.h"
#include "nodes/motion/encoded_root.h"

namespace kinegraph {

class DecomposedPose {
 public:
  // Both outlive this.
  DecomposedPose(const ChannelSpace& space, const Motion& motion, Work& work);

  // `joint`: of the space's skeleton, here and below. At rest where the motion lacks it. The root's rotation
  // is ρ, in world, or in world as it stands.
  Quat local(int joint, std::size_t t) const;
  // From the parent to `joint`, in the parent's frame, of as many frames as fit, from `begin` on.
  void links(int joint, std::size_t begin, Vec3Track out) const;
  // The motion's joint, or -1.
  int joint(int of_space) const { return joint_of_[of_space]; }
  const EncodedRoot& root() const { return root_; }
  // What was taken out of a frame: x = facing⁻¹ (world - place) / above_scale.
  Vec3 root_place(std::size_t t) const;
  Quat root_facing(std::size_t t) const;  // R_y(ψ); identity where the heading stays in
  const Motion& motion() const { return motion_; }
  bool heading() const { return space_.heading; }
  // The space's joints with this motion's own bones.
  const Skeleton& skeleton() const { return skeleton_; }

 private:
  const ChannelSpace& space_;
  const Motion& motion_;
  EncodedRoot root_;
  std::vector<int> joint_of_;
  Skeleton skeleton_;
  std::vector<double> stretch_;  // the space's length of each link by the motion's
};

// Positions of all joints with the root at the origin, and orientations in world and local, of some frames.
// Outlives neither the pose nor its motion.
struct RootedPoses {
  JointPositions positions;
  JointRotations world;
  std::vector<ConstQuatTrack> local;
  std::vector<JointRotations> own_local;  // of joints whose rotations aren't the motion's own
  std::size_t frames() const { return positions.frames(); }
};
// Frames [begin, end) into `poses`, whose memory is used again.
void rooted_poses(const DecomposedPose& motion, std::size_t begin, std::size_t end, RootedPoses& poses);

// How many frames are done at a time: so many that all their poses stay in the second cache.
constexpr std::size_t frames_at_a_time = 64;

}  // namespace kinegraph
