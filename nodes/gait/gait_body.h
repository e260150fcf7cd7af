// How pelvis, trunk, head and arms move over the feet of a gait: smooth waves of the cycle's phase.
#pragma once
#include <array>
#include <cstdint>

#include "nodes/gait/gait_skeleton.h"
#include "nodes/gait/gait_styles.h"

namespace kinegraph {

struct BodyPose {
  Vec3 hips;    // world, without the height that the legs allow; metres
  Quat pelvis;  // world
  // Local rotations.
  Quat spine, spine1, neck, head;
  struct Arm {
    Quat shoulder, arm, fore_arm, hand;
  };
  std::array<Arm, 2> arms;  // left, right
};
// `cycles`: the phase that counts on, 0 = a touch-down of the left foot. `speed` in m/s, `seconds` since the
// start.
BodyPose body_pose(const GaitStyle& style, double cycles, double seconds, double speed, std::uint64_t seed);

}  // namespace kinegraph
