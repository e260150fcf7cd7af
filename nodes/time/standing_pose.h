// A pose in which a body stands upright, so that two bodies can be compared: the rest pose, or, where that
// shows no body (bones along one axis, a figure on its back), the most upright frame of a motion.
#pragma once
#include <optional>
#include <vector>

#include "nodes/motion/body.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

struct StandingPose {
  Pose pose;                         // world
  std::optional<std::size_t> frame;  // none = the rest pose
  bool upright = false;              // within 50° at spine and legs
  std::optional<double> facing;      // rad about up, 0 = +z, towards +x; none = no left and right
  // Each leg's foot when its sole is flat: where the pose is a frame, the frame in which the foot is lowest.
  std::vector<Pose> flat;
};
StandingPose standing_pose(const Motion& motion, const WorldMotion& world, const Body& body);

// The direction of a vector about up; none where it is nearly upright.
std::optional<double> yaw_of(Vec3 v);

// Where the ball of a leg's foot is: the toe joint, else the toe's tip; none: neither.
std::optional<Vec3> ball_of(const Leg& leg, const Pose& pose, double scale);

}  // namespace kinegraph
