// Forward kinematics along time.
#pragma once
#include <memory>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// World positions (metres) and orientations of all joints, channel-contiguous like a Motion.
class WorldMotion {
 public:
  WorldMotion(int joints, std::size_t frames, double scale = 1);
  std::size_t frames() const { return frames_; }
  int joints() const { return joints_; }
  double scale() const { return scale_; }  // Skeleton::above_scale: of lengths in a joint's frame
  void hold(std::shared_ptr<void> reserved) { reserved_ = std::move(reserved); }  // memory announced for this
  Vec3Track position(int joint);
  ConstVec3Track position(int joint) const;
  QuatTrack orientation(int joint);
  ConstQuatTrack orientation(int joint) const;

 private:
  int joints_;
  std::size_t frames_;
  double scale_;
  std::vector<double> data_;
  std::shared_ptr<void> reserved_;
};
WorldMotion world_motion(const Motion& motion, Work& work);
WorldMotion world_motion(const Motion& motion);
// World position of a point fixed in a joint's frame (an End Site).
Vec3 point_at(const WorldMotion& world, int joint, Vec3 local, std::size_t frame);

// One frame.
struct Pose {
  std::vector<Vec3> positions;
  std::vector<Quat> orientations;
};
Pose pose_at(const Motion& motion, std::size_t frame);

}  // namespace kinegraph
