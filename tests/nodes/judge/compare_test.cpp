#include "nodes/judge/compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/style/small_motion.h"

namespace kinegraph {
namespace {

const Vec3 right{1, 0, 0};

TEST(CompareMotions, FindsNothingBetweenAMotionAndItself) {
  SmallMotion nodding;
  nodding.head = [](double time) { return axis_angle(right, std::sin(3 * time)); };
  const Motion a = nodding.made(60);
  Alone work;
  const Comparison same = compare_motions(a, a, {}, work);
  EXPECT_TRUE(same.identical);
  EXPECT_EQ(same.compared, 60u);
  EXPECT_EQ(same.joints.size(), 3u);
  EXPECT_EQ(same.position_max, 0);
  EXPECT_LT(same.rotation_max, 1e-5);
}

TEST(CompareMotions, NamesTheJointTheSizeAndTheFrameOfADifference) {
  const Motion a = SmallMotion{}.made(50);
  Motion b = a;
  b.rotation(1).set(20, axis_angle(right, 0.1));
  Alone work;
  const Comparison found = compare_motions(a, b, {}, work);
  EXPECT_FALSE(found.identical);
  EXPECT_NEAR(found.joints[1].rotation_max, 0.1 * 180 / 3.14159265358979, 1e-9);
  EXPECT_EQ(found.joints[1].rotation_frame, 20u);
  EXPECT_NEAR(found.joints[1].rotation_mean, found.joints[1].rotation_max / 50, 1e-9);
  EXPECT_LT(found.joints[2].rotation_max, 1e-9);
  // The head rides on the spine, 0.4 m above it.
  EXPECT_NEAR(found.joints[2].position_max, 2 * 0.4 * std::sin(0.05), 1e-12);
  EXPECT_EQ(found.joints[2].position_frame, 20u);
  EXPECT_EQ(found.position_max, found.joints[2].position_max);
}

TEST(CompareMotions, ComparesWhatBothHave) {
  Alone work;
  const Motion a = SmallMotion{}.made(50);
  const Motion b = SmallMotion{}.made(40);
  const Comparison found = compare_motions(a, b, {}, work);
  EXPECT_EQ(found.compared, 40u);
  EXPECT_FALSE(found.identical);
  EXPECT_EQ(*metrics_of(found).find("difference.frames")->value, -10);
  EXPECT_EQ(*metrics_of(found).find("difference.position_max")->value, 0);
}

TEST(CompareMotions, HasNothingToSayOfNoFrames) {
  Alone work;
  const Motion a = SmallMotion{}.made(0);
  const Comparison found = compare_motions(a, a, {}, work);
  EXPECT_TRUE(found.identical);
  EXPECT_FALSE(metrics_of(found).find("difference.position_max")->value);
}

}  // namespace
}  // namespace kinegraph
