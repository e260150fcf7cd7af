// Wu's Fig. 2: linear transfer of Euler angles jerks where quaternions don't.
#include <gtest/gtest.h>

#include "nodes/judge/measures.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/style/style_transfer.h"
#include "tests/nodes/style/cmu_clips.h"

namespace kinegraph {
namespace {

// Largest angular acceleration of the body without its hands (whose markers jitter in the source already),
// after a transfer in one space or the other.
Metrics after_transfer(const std::string& source, const std::string& style, StyleSpace space) {
  const Motion motion = cmu_clip(source);
  Alone work;
  QuatStatsParams measured;
  measured.space = space;
  StyleTransferParams params;
  params.space = space;
  params.max_gain = 4;
  const Motion result =
      style_transfer(motion, quat_stats(cmu_clip(style), measured, work), nullptr, params, work).motion;
  MeasureParams judged;
  judged.joints = chosen_joints("-*Hand*,-*Finger*,-*Thumb*", result.skeleton(), "joints", work);
  return measure(result, nullptr, nullptr, judged, work);
}

TEST(EulerVersusQuaternion, AnglesJerkTheArmOfAJumperGivenABoxersStyle) {
  KINEGRAPH_NEEDS_MOCAP();
  const Metrics quaternion = after_transfer("02_04", "02_05", StyleSpace::quaternion);
  const Metrics euler = after_transfer("02_04", "02_05", StyleSpace::euler);
  const auto all = [](const Metrics& metrics) { return *metrics.find("angular_acceleration_max")->value; };
  EXPECT_GT(all(euler), 1.3 * all(quaternion));
  const auto arm = [](const Metrics& metrics) {
    return *metrics.find("angular_acceleration_max.RightArm")->value;
  };
  EXPECT_GT(arm(euler), 1.5 * arm(quaternion));
}

TEST(EulerVersusQuaternion, AnglesJerkTheArmOfAWalkGivenAStride) {
  KINEGRAPH_NEEDS_MOCAP();
  const auto arm = [](StyleSpace space) {
    return *after_transfer("02_01", "08_05", space).find("angular_acceleration_max.LeftArm")->value;
  };
  EXPECT_GT(arm(StyleSpace::euler), 1.3 * arm(StyleSpace::quaternion));
}

}  // namespace
}  // namespace kinegraph
