// The standard human of Gait: 23 joints named as in the CMU BVH files, 1.75 m tall, T-pose at rest, facing
// +Z, left = +X.
#pragma once
#include <memory>

#include "nodes/motion/motion.h"

namespace kinegraph {

// Body measures, metres. Proportions after Winter, Biomechanics and Motor Control of Human Movement,
// table 4.1.
struct GaitBody {
  double thigh = 0.42, shank = 0.42;
  double ankle_height = 0.075;                    // of the ankle joint over the sole
  double ball_ahead = 0.13;                       // of the toe joint before the ankle
  double ball_height = 0.02;                      // of the toe joint over the sole
  double heel_behind = 0.05;                      // of the heel's ground point behind the ankle
  double toe_length = 0.07;                       // toe joint to the tip
  double hip_half_width = 0.09, hip_drop = 0.03;  // of a hip joint from the root
  double leg() const { return thigh + shank; }
};

enum GaitJoint : int {
  hips,
  left_up_leg,
  left_leg,
  left_foot,
  left_toe_base,
  right_up_leg,
  right_leg,
  right_foot,
  right_toe_base,
  spine,
  spine1,
  neck,
  head,
  left_shoulder,
  left_arm,
  left_fore_arm,
  left_hand,
  left_hand_index,
  right_shoulder,
  right_arm,
  right_fore_arm,
  right_hand,
  right_hand_index,
  gait_joint_count
};

std::shared_ptr<const Skeleton> gait_skeleton(const GaitBody& body);
// A BVH in centimetres with Z, Y, X rotations as the CMU files have them.
std::shared_ptr<const SourceFacts> gait_source_facts(const Skeleton& skeleton, double fps);

}  // namespace kinegraph
