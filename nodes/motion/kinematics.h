// Forward kinematics along time.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// World positions (metres) and orientations of all joints, channel-contiguous like a Motion.
class WorldMotion {
 public:
  WorldMotion(int joints, std::size_t frames);
  std::size_t frames() const { return frames_; }
  int joints() const { return joints_; }
  Vec3Track position(int joint);
  ConstVec3Track position(int joint) const;
  QuatTrack orientation(int joint);
  ConstQuatTrack orientation(int joint) const;

 private:
  int joints_;
  std::size_t frames_;
  std::vector<double> data_;
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
