#include "nodes/time/motion_warp.h"

#include <gmock/gmock.h>

#include "nodes/motion/kinematics.h"
#include "nodes/time/displacement.h"
#include "nodes/time/limb.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

Diagnostic failure_of(const Motion& motion, const std::vector<WarpKey>& keys) {
  Alone work;
  try {
    motion_warp(motion, keys, work);
  } catch (const Failure& failure) {
    return failure.diagnostic();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

double bones_differ(const Motion& a, const Motion& b) {
  double worst = 0;
  for (std::size_t f = 0; f < a.frames(); ++f)
    for (int j = 1; j < a.joints(); ++j)
      worst = std::max(worst, norm(a.local_offset(j, f) - b.local_offset(j, f)));
  return worst;
}

TEST(DisplacementCurve, PassesThroughItsKnotsAndIsSmooth) {
  const std::map<std::size_t, Vec3> knots{{30, {1, 0, 2}}, {50, {-1, 0.5, 0}}, {120, {0.3, 0, 0}}};
  const auto curve = displacement_curve(knots, 200);
  for (const auto& [frame, value] : knots) EXPECT_LT(norm(curve[frame] - value), 1e-12);
  EXPECT_EQ(curve.front(), Vec3{});
  EXPECT_LT(norm(curve.back()), 1e-12);
  // Curvature is continuous: its change from frame to frame is what the pieces' constant third derivatives
  // make of it.
  double third = 0;
  for (std::size_t f = 3; f < 200; ++f)
    third = std::max(third, norm(curve[f] - 3 * curve[f - 1] + 3 * curve[f - 2] - curve[f - 3]));
  double second = 0;
  for (std::size_t f = 2; f < 200; ++f)
    second = std::max(second, norm(curve[f] - 2 * curve[f - 1] + curve[f - 2]));
  EXPECT_LT(third, 0.2 * second)
      << "a jump in curvature would make a third difference as large as the second";
  EXPECT_LT(norm(curve[1]), 0.01) << "level at the ends";
}

TEST(DisplacementCurve, RestsFromOneKnotOfNothingToTheNext) {
  const auto curve = displacement_curve({{100, {}}, {150, {0, 1, 0}}, {160, {0, 1, 0}}, {200, {}}}, 400);
  for (std::size_t f = 0; f < 400; ++f) {
    if (f <= 100 || f >= 200) {
      EXPECT_EQ(curve[f], Vec3{}) << f;
    } else {
      EXPECT_GT(curve[f].y, 0) << f;
    }
  }
  EXPECT_LT(curve[101].y, 0.01) << "level where it begins";
  EXPECT_LT(curve[199].y, 0.01);
  EXPECT_GT(curve[155].y, 1) << "between knots of the same value it goes on as a spline";
}

TEST(MotionWarp, MeetsARotationAndLeavesTheRestAlone) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const int arm = walk.skeleton().find("LeftArm");
  const Quat wanted = axis_angle({0, 0, 1}, 1.2) * walk.rotation(arm)[60];
  const Motion out = motion_warp(walk, {{60, "LeftArm", wanted, {}}}, work);
  EXPECT_LT(turn(out.rotation(arm)[60], wanted), 1e-9);
  EXPECT_LT(turn(out.rotation(arm)[0], walk.rotation(arm)[0]), 1e-9);
  EXPECT_LT(turn(out.rotation(arm)[119], walk.rotation(arm)[119]), 1e-9);
  for (int j = 0; j < walk.joints(); ++j) {
    if (j == arm) continue;
    for (std::size_t f = 0; f < walk.frames(); ++f)
      ASSERT_LT(turn(out.rotation(j)[f], walk.rotation(j)[f]), 1e-12);
  }
}

TEST(MotionWarp, AnAnchorKeepsTheChangeOut) {
  Alone work;
  Motion walk = gait("walk", 2);
  const int arm = walk.skeleton().find("LeftArm");
  for (std::size_t f = 0; f < walk.frames(); ++f)  // about no axis in particular
    walk.rotation(arm).set(f, axis_angle(normalized(Vec3{1, 2, 3}), 0.7) * walk.rotation(arm)[f]);
  const Quat wanted = axis_angle({0, 0, 1}, 1.2) * walk.rotation(arm)[60];
  const Motion out = motion_warp(walk, {{60, "LeftArm", wanted, {}}, {80, "LeftArm", {}, {}}}, work);
  EXPECT_LT(turn(out.rotation(arm)[60], wanted), 1e-9);
  // Nor is the arm swung to the other side beyond it.
  for (std::size_t f = 80; f < walk.frames(); ++f)
    EXPECT_LT(turn(out.rotation(arm)[f], walk.rotation(arm)[f]), 1e-7) << f;
}

TEST(MotionWarp, ReachesPositionsWithTheLimbAndKeepsBones) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const int hand = walk.skeleton().find("RightHand"), foot = walk.skeleton().find("LeftFoot");
  const Vec3 up = pose_at(walk, 50).positions[hand] + Vec3{0.05, 0.2, 0.1};
  const Vec3 high = pose_at(walk, 70).positions[foot] + Vec3{0, 0.15, 0.05};
  // The spine is keyed elsewhere, so that the hand has to be found again where the spine's curve has moved
  // the shoulder.
  const int spine = walk.skeleton().find("Spine");
  const std::vector<WarpKey> keys{{50, "RightHand", {}, up},
                                  {70, "LeftFoot", {}, high},
                                  {40, "Spine", axis_angle({1, 0, 0}, 0.2) * walk.rotation(spine)[40], {}}};
  const Motion out = motion_warp(walk, keys, work);
  EXPECT_LT(norm(pose_at(out, 50).positions[hand] - up), 1e-6);
  EXPECT_LT(norm(pose_at(out, 70).positions[foot] - high), 1e-6);
  EXPECT_EQ(bones_differ(out, walk), 0);
  // Nothing pops: accelerations stay near the input's.
  const auto largest_acceleration = [](const Motion& motion, int joint) {
    const WorldMotion world = world_motion(motion);
    double worst = 0;
    for (std::size_t f = 1; f + 1 < motion.frames(); ++f)
      worst = std::max(worst, norm(world.position(joint)[f + 1] - 2 * world.position(joint)[f] +
                                   world.position(joint)[f - 1]));
    return worst * motion.fps() * motion.fps();
  };
  EXPECT_LT(largest_acceleration(out, hand), largest_acceleration(walk, hand) + 20);
  EXPECT_LT(largest_acceleration(out, foot), largest_acceleration(walk, foot) + 40);
}

TEST(MotionWarp, MovesTheRootThroughPositions) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const Vec3 wanted = pose_at(walk, 60).positions[0] + Vec3{0.3, -0.1, 0};
  const Motion out = motion_warp(walk, {{60, "Hips", {}, wanted}}, work);
  EXPECT_LT(norm(pose_at(out, 60).positions[0] - wanted), 1e-12);
  EXPECT_LT(norm(out.local_offset(0, 0) - walk.local_offset(0, 0)), 1e-12);
}

TEST(MotionWarp, StraightensALegAsFarAsItGoes) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const Skeleton& skeleton = walk.skeleton();
  const int hip = skeleton.find("LeftUpLeg"), knee = skeleton.find("LeftLeg"),
            foot = skeleton.find("LeftFoot");
  const Vec3 from = pose_at(walk, 40).positions[hip];
  const double reach = skeleton.link_length(knee) + skeleton.link_length(foot);
  const Vec3 full = from + reach * normalized(Vec3{0, -1, 0.3});
  const Motion out = motion_warp(walk, {{40, "LeftFoot", {}, full}}, work);
  EXPECT_LT(norm(pose_at(out, 40).positions[foot] - full), 1e-6);
  const Diagnostic far = failure_of(walk, {{40, "LeftFoot", {}, from + 1.1 * (full - from)}});
  EXPECT_EQ(far.code, "out-of-reach");
  EXPECT_EQ(far.param, "keys[0].position");
  EXPECT_EQ(far.joint, "LeftFoot");
  EXPECT_EQ(far.frame, 40);
}

TEST(MotionWarp, WithoutKeysChangesNothing) {
  Alone work;
  const Motion walk = gait("walk", 1);
  EXPECT_LT(difference(motion_warp(walk, {}, work), walk).turn, 1e-12);
  const Motion held = motion_warp(walk, {{30, "LeftHand", {}, {}}}, work);
  EXPECT_LT(difference(held, walk).turn, 1e-7);
}

TEST(MotionWarp, TakesOneFrame) {
  Alone work;
  const Motion one = gait("walk", 1).empty_like(1);
  const Quat wanted = axis_angle({1, 0, 0}, 0.5);
  EXPECT_LT(
      turn(motion_warp(one, {{0, "LeftArm", wanted, {}}}, work).rotation(one.skeleton().find("LeftArm"))[0],
           wanted),
      1e-9);
}

TEST(MotionWarp, NamesWhatIsWrongWithAKey) {
  const Motion walk = gait("walk", 1);
  const Quat none;
  EXPECT_EQ(failure_of(walk, {{60, "LeftArm", none, {}}}).param, "keys[0].frame");
  const Diagnostic unknown = failure_of(walk, {{1, "LeftArm", none, {}}, {1, "LeftArn", none, {}}});
  EXPECT_EQ(unknown.param, "keys[1].joint");
  EXPECT_THAT(unknown.hint, testing::HasSubstr("LeftArm"));
  EXPECT_EQ(failure_of(walk, {{1, "LeftArm", none, Vec3{}}}).code, "bad-key");
  EXPECT_EQ(failure_of(walk, {{1, "LeftArm", Quat{0, 0, 0, 0}, {}}}).code, "bad-key");
  const Diagnostic twice = failure_of(walk, {{1, "LeftArm", none, {}}, {1, "LeftArm", none, {}}});
  EXPECT_EQ(twice.code, "duplicate-key");
  EXPECT_EQ(twice.frame, 1);
  EXPECT_EQ(twice.hint, "keep one of the two");
  EXPECT_EQ(failure_of(walk, {{1, "Spine", {}, Vec3{}}}).code, "no-limb");
  const Vec3 hand = pose_at(walk, 9).positions[walk.skeleton().find("LeftHand")] + Vec3{0, 0.1, 0};
  EXPECT_EQ(failure_of(walk, {{9, "LeftArm", none, {}}, {9, "LeftHand", {}, hand}}).code, "keys-conflict");
}

TEST(LimbOf, FindsKneesAndElbows) {
  const Motion walk = gait("walk", 1);
  const Skeleton& skeleton = walk.skeleton();
  const auto names = [&](const char* joint) {
    const Limb limb = limb_of(skeleton, skeleton.find(joint)).value();
    return skeleton.joints[limb.upper].name + " " + skeleton.joints[limb.middle].name;
  };
  EXPECT_EQ(names("LeftFoot"), "LeftUpLeg LeftLeg");
  EXPECT_EQ(names("LeftToeBase"), "LeftUpLeg LeftLeg");
  EXPECT_EQ(names("RightHand"), "RightArm RightForeArm");
}

}  // namespace
}  // namespace kinegraph
