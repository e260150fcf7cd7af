#include "nodes/motion/moving_root.h"

#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/metrics.h"
#include "nodes/style/stats.h"
#include "nodes/time/warp.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

double farthest_apart(const Motion& a, const Motion& b) {
  const WorldMotion p = world_motion(a), q = world_motion(b);
  double most = 0;
  for (int joint = 1; joint < a.joints(); ++joint)
    for (std::size_t t = 0; t < a.frames(); ++t) {
      most = std::max(most, norm(p.position(joint)[t] - q.position(joint)[t]));
      most = std::max(most, turn(p.orientation(joint)[t], q.orientation(joint)[t]));
    }
  return most;
}

// The walk hung below a root that stays at the origin.
Motion below_a_still_root(const Motion& walk) {
  auto skeleton = std::make_shared<Skeleton>(walk.skeleton());
  skeleton->joints.insert(skeleton->joints.begin(), {"reference", -1, {}, {}});
  for (std::size_t j = 1; j < skeleton->joints.size(); ++j) ++skeleton->joints[j].parent;
  for (EndSite& end : skeleton->ends) ++end.joint;
  std::vector<bool> translates(skeleton->joints.size(), false);
  translates[1] = true;
  Motion out(skeleton, walk.shared_source(), walk.fps(), walk.frames(), translates);
  for (int j = 0; j < walk.joints(); ++j)
    for (std::size_t t = 0; t < walk.frames(); ++t) out.rotation(j + 1).set(t, walk.rotation(j)[t]);
  for (std::size_t t = 0; t < walk.frames(); ++t) out.translation(1).set(t, walk.local_offset(0, t));
  return out;
}

TEST(MovingRoot, GivesTheRootThePathAndHeadingOfWhatCarriesTheBody) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const auto hung = std::make_shared<const Motion>(below_a_still_root(walk));
  const auto told = with_moving_root(hung, work);
  ASSERT_NE(told, hung);
  EXPECT_LT(farthest_apart(*told, *hung), 1e-9);
  const EncodedRoot is = encode_root(*told, work), was = encode_root(walk, work);
  for (std::size_t t = 0; t < walk.frames(); ++t) {
    EXPECT_NEAR(is.heading[t], was.heading[t], 1e-9);
    EXPECT_NEAR(is.height[t], was.height[t], 1e-9);
    EXPECT_NEAR(is.d_z[t], was.d_z[t], 1e-6);
  }
}

TEST(MovingRoot, LeavesMotionsAloneWhoseRootMoves) {
  Alone work;
  const auto walk = std::make_shared<const Motion>(gait("walk", 1));
  EXPECT_EQ(with_moving_root(walk, work), walk);
}

TEST(MovingRoot, IsFoundInClipsWithAReferenceJoint) {
  KINEGRAPH_NEEDS_MOCAP();
  PlainFiles files;
  Alone work;
  ReadOptions options;
  options.unit = "cm";
  const MotionFile file = read_motion_file(mocap("bandai/dataset-1_walk_old_001.bvh"), options, files, work);
  const auto motion = std::make_shared<const Motion>(*file.motion());
  const auto told = with_moving_root(motion, work);
  ASSERT_NE(told, motion);
  EXPECT_LT(farthest_apart(*told, *motion), 1e-9);
  EXPECT_GT(norm(told->local_offset(0, told->frames() - 1) - told->local_offset(0, 0)), 3.0);
}

TEST(MovingRoot, IsToldOfAllMotionsWhereItIsOfOne) {
  Alone work;
  const Motion walk = gait("walk", 1);
  const auto hung = std::make_shared<const Motion>(below_a_still_root(walk));
  Motion standing = below_a_still_root(walk);
  for (int j = 0; j < standing.joints(); ++j)
    for (std::size_t t = 0; t < standing.frames(); ++t) standing.rotation(j).set(t, standing.rotation(j)[0]);
  for (std::size_t t = 0; t < standing.frames(); ++t)
    standing.translation(1).set(t, standing.translation(1)[0]);
  const auto still = std::make_shared<const Motion>(std::move(standing));
  EXPECT_EQ(with_moving_root(still, work), still);
  const auto told = with_moving_roots({still, hung}, work);
  EXPECT_LT(farthest_apart(*told[0], *still), 1e-9);
  EXPECT_GT(told[0]->local_offset(0, 0).y, 0.5) << "its root stands where the other's does";
}

TEST(MovingRoot, IsAboveJointsThatCarryTheLegs) {
  const Motion walk = gait("walk", 1);
  const Motion hung = below_a_still_root(walk);
  for (int j = 0; j < walk.joints(); ++j) EXPECT_FALSE(carries_the_legs(walk.skeleton(), j));
  for (int j = 0; j < hung.joints(); ++j) EXPECT_EQ(carries_the_legs(hung.skeleton(), j), j == 1);
}

// Nodes that work on the path and heading of the root do to a body below a still root what they do to one
// without.
class BodiesBelowAStillRoot : public testing::Test {
 protected:
  static NodeInMemory node(const char* type) { return NodeInMemory(*all_nodes().find(type)); }
  // Of each joint's places in the one and in the other.
  static double farthest(const Motion& hung, const Motion& plain) {
    const WorldMotion p = world_motion(hung), q = world_motion(plain);
    double most = hung.frames() == plain.frames() ? 0 : 1e9;
    for (int joint = 0; joint < plain.joints(); ++joint)
      for (std::size_t t = 0; t < std::min(hung.frames(), plain.frames()); ++t)
        most = std::max(most, norm(p.position(joint + 1)[t] - q.position(joint)[t]));
    return most;
  }
  Motion walk = gait("walk", 2), sneak = gait("sneak", 2);
  Motion hung_walk = below_a_still_root(walk), hung_sneak = below_a_still_root(sneak);
};

TEST_F(BodiesBelowAStillRoot, GoOnWhereTheOneBeforeEnds) {
  NodeInMemory plain = node("Concatenate"), hung = node("Concatenate");
  plain.link("motions", walk).link("motions", sneak).set("blend", 0.2).run();
  hung.link("motions", hung_walk).link("motions", hung_sneak).set("blend", 0.2).run();
  EXPECT_LT(farthest(hung.out<Motion>("motion"), plain.out<Motion>("motion")), 0.01);
}

TEST_F(BodiesBelowAStillRoot, BlendTheirPaths) {
  for (double weight : {0.0, 0.5, 1.0}) {
    NodeInMemory plain = node("Blend"), hung = node("Blend");
    plain.link("motion", walk).link("other", sneak).set("weight", weight).run();
    hung.link("motion", hung_walk).link("other", hung_sneak).set("weight", weight).run();
    EXPECT_LT(farthest(hung.out<Motion>("motion"), plain.out<Motion>("motion")), 0.01) << weight;
  }
}

TEST_F(BodiesBelowAStillRoot, TakeTravelAndHeightOfAStyle) {
  const auto restyled = [](const Motion& source, const Motion& reference) {
    NodeInMemory warp = node("TimeWarp"), stats = node("QuatStats"), transfer = node("StyleTransfer"),
                 unwarp = node("UnwarpTime");
    warp.link("source", source).link("reference", reference).run();
    stats.link("motion", Motion(warp.out<Motion>("reference"))).run();
    transfer.link("motion", Motion(warp.out<Motion>("warped")))
        .link("style", Stats(stats.out<Stats>("stats")))
        .run();
    unwarp.link("motion", Motion(transfer.out<Motion>("motion")))
        .link("warp", Warp(warp.out<Warp>("warp")))
        .run();
    return Motion(unwarp.out<Motion>("motion"));
  };
  const Motion plain = restyled(walk, sneak), hung = restyled(hung_walk, hung_sneak);
  ASSERT_GT(norm(plain.local_offset(0, plain.frames() - 1) - walk.local_offset(0, walk.frames() - 1)), 0.2)
      << "or no travel is taken";
  EXPECT_LT(farthest(hung, plain), 0.05);
}

TEST_F(BodiesBelowAStillRoot, AreMeasuredLikeOthers) {
  NodeInMemory plain = node("Metrics"), hung = node("Metrics");
  plain.link("motion", walk).link("reference", sneak).run();
  hung.link("motion", hung_walk).link("reference", hung_sneak).run();
  const auto value = [](NodeInMemory& metrics, const char* name) {
    return metrics.out<Metrics>("metrics").find(name)->value.value();
  };
  EXPECT_EQ(value(hung, "bone_drift"), 0) << "where the hips stand is no bone";
  EXPECT_NEAR(value(hung, "style_distance.LeftUpLeg"), value(plain, "style_distance.LeftUpLeg"), 1e-6);
  EXPECT_NEAR(value(hung, "aligned_distance.LeftFoot"), value(plain, "aligned_distance.LeftFoot"), 0.01);
  for (const Diagnostic& told : hung.reported()) EXPECT_NE(told.code, "rest-pose-differs");
}

}  // namespace
}  // namespace kinegraph
