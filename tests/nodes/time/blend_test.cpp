#include "nodes/time/blend.h"

#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
namespace {

NodeInMemory blend(const Motion& motion, const Motion& other) {
  NodeInMemory node(*all_nodes().find("Blend"));
  node.link("motion", motion).link("other", other);
  return node;
}

class Blend : public ::testing::Test {
 protected:
  Motion a = sample_motion(40, 120, 1), b = sample_motion(40, 120, 2);
};

TEST_F(Blend, of_weight_zero_is_motion_and_of_one_the_other) {
  auto zero = blend(a, b), one = blend(a, b);
  EXPECT_EQ(encoded(zero.set("weight", 0).run().out<Motion>("motion")), encoded(a));
  EXPECT_EQ(encoded(one.set("weight", 1).run().out<Motion>("motion")), encoded(b));
}

TEST_F(Blend, turns_each_joint_part_of_the_way_and_beyond) {
  for (double weight : {-0.5, 0.25, 0.5, 1.5}) {
    auto node = blend(a, b);
    const auto& out = node.set("weight", weight).run().out<Motion>("motion");
    for (int j = 0; j < a.joints(); ++j) {
      double whole = turn(a.rotation(j)[9], b.rotation(j)[9]);
      if (whole > 1) continue;  // beyond the half turn distances shrink again
      EXPECT_NEAR(turn(a.rotation(j)[9], out.rotation(j)[9]), std::fabs(weight) * whole, 1e-12);
      EXPECT_NEAR(turn(b.rotation(j)[9], out.rotation(j)[9]), std::fabs(1 - weight) * whole, 1e-12);
    }
    Vec3 p = a.translation(0)[9] + weight * (b.translation(0)[9] - a.translation(0)[9]);
    EXPECT_LT(norm(out.translation(0)[9] - p), 1e-14);
  }
}

TEST_F(Blend, keeps_to_joints_and_range) {
  auto node = blend(a, b);
  node.set("weight", 1).set("joints", "Head").set("range", Json::Array{10, 20});
  const auto& out = node.run().out<Motion>("motion");
  int head = a.skeleton().find("Head"), spine = a.skeleton().find("Spine");
  EXPECT_EQ(out.rotation(head)[10], b.rotation(head)[10]);
  EXPECT_LT(turn(out.rotation(head)[20], a.rotation(head)[20]), 1e-15);
  EXPECT_EQ(out.rotation(spine)[10], a.rotation(spine)[10]);
  EXPECT_EQ(out.translation(0)[15], a.translation(0)[15]);
}

TEST_F(Blend, finds_partners_by_name_and_keeps_the_motion_of_the_others) {
  Skeleton renamed = sample_skeleton();
  renamed.joints[3].name = "Other";
  Motion other = sample_motion(40, 120, 2, renamed);
  auto node = blend(a, other);
  const auto& out = node.set("weight", 1).run().out<Motion>("motion");
  EXPECT_EQ(out.rotation(3)[5], a.rotation(3)[5]);
  EXPECT_EQ(out.rotation(4)[5], other.rotation(4)[5]);
  ASSERT_EQ(node.reported().size(), 1u);
  EXPECT_EQ(node.reported()[0].code, "no-partner");

  auto mapped = blend(a, other);
  mapped.set("weight", 1).set("map", Json::Array{"Other=LeftFoot"});
  EXPECT_EQ(mapped.run().out<Motion>("motion").rotation(3)[5], other.rotation(3)[5]);
  EXPECT_EQ(mapped.out<Motion>("motion").rotation(4)[5], a.rotation(4)[5]);
}

TEST_F(Blend, roots_meet_in_world_where_fixed_parents_differ) {
  Skeleton turned = sample_skeleton();
  turned.above = axis_angle({1, 0, 0}, -pi / 2);
  turned.above_offset = {1, 2, 3};
  turned.above_scale = 0.01;
  Motion other = sample_motion(40, 120, 2, turned);
  auto node = blend(a, other);
  const auto& out = node.set("weight", 1).run().out<Motion>("motion");
  Pose truth = pose_at(other, 7), pose = pose_at(out, 7);
  EXPECT_LT(norm(pose.positions[0] - truth.positions[0]), 1e-14);
  EXPECT_LT(turn(pose.orientations[0], truth.orientations[0]), 1e-14);
}

TEST_F(Blend, an_other_that_ends_too_early_is_refused_unless_the_range_does_too) {
  Motion shorter = sample_motion(30, 120, 2);
  Diagnostic d = blend(a, shorter).refusal();
  EXPECT_EQ(d.code, "too-short");
  EXPECT_EQ(d.port, "other");
  auto node = blend(a, shorter);
  EXPECT_EQ(node.set("range", Json::Array{0, 30}).run().out<Motion>("motion").frames(), 40u);
}

TEST_F(Blend, rates_must_agree) {
  Diagnostic d = blend(a, sample_motion(40, 60, 2)).refusal();
  EXPECT_EQ(d.code, "rate-mismatch");
  EXPECT_NE(d.hint.find("Resample"), std::string::npos);
}

}  // namespace
}  // namespace kinegraph
