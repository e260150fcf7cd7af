#include "nodes/style/quat_stats.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/gait/gait.h"
#include "tests/nodes/style/small_motion.h"

namespace kinegraph {
namespace {

const Vec3 right{1, 0, 0};

Motion gait(const char* name, double seconds = 3) {
  Alone work;
  GaitParams params;
  params.gait = name;
  params.seconds = seconds;
  return make_gait(params, work);
}

// Root mean square of the half-angle to the mean, straight from the definition.
double spread_by_definition(const ConstQuatTrack& track, Quat mean) {
  double sum = 0;
  for (std::size_t t = 0; t < track.x.size(); ++t) {
    sum += std::pow(std::acos(std::min(1.0, std::fabs(dot(mean, track[t])))), 2);
  }
  return std::sqrt(sum / static_cast<double>(track.x.size()));
}

TEST(QuatStats, MeasuresEveryJointOfAWalk) {
  const Motion walk = gait("walk");
  Alone work;
  const Stats stats = quat_stats(walk, {}, work);
  ASSERT_EQ(stats.joints.size(), walk.skeleton().joints.size());
  for (int j = 1; j < walk.joints(); ++j) {
    const JointStats& joint = stats.joints[static_cast<std::size_t>(j)];
    EXPECT_EQ(joint.joint, walk.skeleton().joints[static_cast<std::size_t>(j)].name);
    // The half-angle by arc cosine is good to some 1e-8 near zero.
    EXPECT_NEAR(joint.spread, spread_by_definition(walk.rotation(j), joint.mean), 3e-8);
  }
  EXPECT_TRUE(work.reported.empty());
  EXPECT_EQ(stats.space, "quaternion");
  EXPECT_EQ(stats.mean_kind, "karcher");
  EXPECT_EQ(stats.frames, walk.frames());
  EXPECT_DOUBLE_EQ(stats.leg_length, leg_length(walk.skeleton()));
}

TEST(QuatStats, TakesTheHeadingOutOfTheRoot) {
  // Turning on the spot by a full turn while leaning 0.2 rad to the front.
  SmallMotion spinning;
  spinning.hips = [](double time) { return about_y(6.28 * time) * axis_angle(right, 0.2); };
  Alone work;
  const Stats stats = quat_stats(spinning.made(121), {}, work);
  EXPECT_LT(turn(stats.joints[0].mean, axis_angle(right, 0.2)), 1e-12);
  EXPECT_LT(stats.joints[0].spread, 1e-12);
  EXPECT_NEAR(stats.root_mean[3], 6.28, 1e-9);
}

TEST(QuatStats, MeasuresTravelInTheHeadingsFramePerSecond) {
  // Walking a circle of radius 1 at 2 m/s, always facing forward, bobbing up and down.
  SmallMotion circling;
  circling.hips = [](double time) { return about_y(2 * time); };
  circling.place = [](double time) {
    return Vec3{-std::cos(2 * time), 1 + 0.05 * std::sin(12 * 3.14159265358979 * time), std::sin(2 * time)};
  };
  for (double fps : {60.0, 120.0}) {
    Alone work;
    const Stats stats = quat_stats(circling.made(static_cast<std::size_t>(3 * fps) + 1, fps), {}, work);
    EXPECT_NEAR(stats.root_mean[1], 2, 1e-3) << "forwards";
    EXPECT_NEAR(stats.root_mean[0], 0, 0.04) << "sideways";
    EXPECT_NEAR(stats.root_spread[1], 0, 1e-9);
    EXPECT_NEAR(stats.root_mean[2], 1, 1e-3) << "height";
    EXPECT_NEAR(stats.root_spread[2], 0.05 / std::sqrt(2), 1e-3);
  }
}

TEST(QuatStats, OfARangeAreThoseOfTheTrimmedMotion) {
  const Motion walk = gait("walk");
  Motion part = walk.empty_like(100);
  for (std::size_t t = 0; t < 100; ++t) {
    for (int j = 0; j < walk.joints(); ++j) {
      part.rotation(j).set(t, walk.rotation(j)[t + 50]);
      if (walk.translates(j)) part.translation(j).set(t, walk.translation(j)[t + 50]);
    }
  }
  QuatStatsParams params;
  params.start = 50;
  params.end = 150;
  Alone work;
  const Stats ranged = quat_stats(walk, params, work);
  const Stats trimmed = quat_stats(part, {}, work);
  EXPECT_EQ(ranged.frames, 100u);
  for (std::size_t j = 0; j < ranged.joints.size(); ++j) {
    EXPECT_LT(turn(ranged.joints[j].mean, trimmed.joints[j].mean), 1e-9);
    EXPECT_NEAR(ranged.joints[j].spread, trimmed.joints[j].spread, 1e-12);
  }
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_NEAR(ranged.root_mean[axis], trimmed.root_mean[axis], 1e-9);
    EXPECT_NEAR(ranged.root_spread[axis], trimmed.root_spread[axis], 1e-9);
  }
}

TEST(QuatStats, LeavesOutJointsThatArentChosen) {
  SmallMotion nodding;
  nodding.head = [](double time) { return axis_angle(right, 0.3 * std::sin(5 * time)); };
  QuatStatsParams params;
  params.joints = {true, false, true};
  Alone work;
  const Stats stats = quat_stats(nodding.made(100), params, work);
  EXPECT_TRUE(stats.joints[0].chosen);
  EXPECT_FALSE(stats.joints[1].chosen);
  EXPECT_EQ(stats.joints[1].joint, "Spine");
  EXPECT_GT(stats.joints[2].spread, 0.05);
}

TEST(QuatStats, OfOneFrameHaveNoSpread) {
  SmallMotion still;
  still.spine = [](double) { return axis_angle(right, 0.4); };
  Alone work;
  const Stats stats = quat_stats(still.made(1), {}, work);
  EXPECT_LT(turn(stats.joints[1].mean, axis_angle(right, 0.4)), 1e-12);
  EXPECT_LT(stats.joints[1].spread, 1e-15);
  EXPECT_EQ(stats.root_mean[1], 0);
  EXPECT_EQ(stats.root_spread[1], 0);
  EXPECT_EQ(stats.root_mean[2], 1);
  EXPECT_FALSE(stats.non_finite());
}

TEST(QuatStats, OfNoFramesAreRefused) {
  Alone work;
  try {
    quat_stats(SmallMotion{}.made(0), {}, work);
    FAIL() << "measured nothing";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "no-frames");
    EXPECT_EQ(failure.diagnostic().port, "motion");
  }
}

TEST(QuatStats, WarnWhereAJointHasNoMean) {
  SmallMotion flipping;  // about two axes, by half-turns: as far from every orientation as can be
  flipping.spine = [](double time) {
    const int which = static_cast<int>(std::lround(time * 120)) % 4;
    return which == 0   ? Quat{}
           : which == 1 ? Quat{1, 0, 0, 0}
           : which == 2 ? Quat{0, 1, 0, 0}
                        : Quat{0, 0, 1, 0};
  };
  Alone work;
  const Stats stats = quat_stats(flipping.made(400), {}, work);
  EXPECT_FALSE(stats.non_finite());
  for (const Diagnostic& told : work.reported) EXPECT_EQ(told.joint, "Spine");
}

TEST(QuatStats, EulerAnglesAreUnwrapped) {
  // The spine turns about y through 180° and on to 270°.
  SmallMotion turning;
  turning.spine = [](double time) { return about_y(4.712 * time); };
  QuatStatsParams params;
  params.space = StyleSpace::euler;
  Motion motion = turning.made(121);
  auto facts = std::make_shared<SourceFacts>();
  facts->bvh.assign(3, BvhJoint{{"Yrotation", "Xrotation", "Zrotation"}, {}});
  motion.set_source(facts);
  Alone work;
  const Stats stats = quat_stats(motion, params, work);
  EXPECT_EQ(stats.space, "euler");
  EXPECT_EQ(stats.joints[1].order, "YXZ");
  EXPECT_NEAR(stats.joints[1].euler_mean[0], 4.712 / 2, 1e-9);
  EXPECT_NEAR(stats.joints[1].euler_spread[0], 4.712 * std::sqrt((121.0 * 121 - 1) / 12) / 120, 1e-9);
  EXPECT_NEAR(stats.joints[1].euler_spread[1], 0, 1e-9);
}

}  // namespace
}  // namespace kinegraph
