#include "nodes/time/concatenate.h"

#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
namespace {

NodeInMemory concatenate(std::vector<Motion> motions) {
  NodeInMemory node(*all_nodes().find("Concatenate"));
  for (Motion& motion : motions) node.link("motions", std::move(motion));
  return node;
}

// Walks straight ahead at 1.5 m/s with a given heading from a given place.
Motion walk(std::size_t frames, double heading, Vec3 from, double speed = 1.5) {
  Motion motion = sample_motion(frames, 120, 3);
  for (std::size_t t = 0; t < frames; ++t) {
    motion.rotation(0).set(t, about_y(heading));
    motion.translation(0).set(t,
                              from + rotate(about_y(heading), {0, 0, speed * static_cast<double>(t) / 120}));
  }
  return motion;
}

class Concatenate : public ::testing::Test {
 protected:
  Motion a = sample_motion(50, 120, 1), b = sample_motion(40, 120, 2), c = sample_motion(30, 120, 3);
};

TEST_F(Concatenate, of_one_motion_is_that_motion) {
  auto node = concatenate({a});
  EXPECT_EQ(encoded(node.run().out<Motion>("motion")), encoded(a));
}

TEST_F(Concatenate, unaligned_puts_frames_behind_frames) {
  auto node = concatenate({a, b, c});
  const auto& out = node.set("align", "none").run().out<Motion>("motion");
  ASSERT_EQ(out.frames(), 120u);
  for (int j = 0; j < a.joints(); ++j) {
    EXPECT_LT(turn(out.rotation(j)[49], a.rotation(j)[49]), 1e-15);
    EXPECT_LT(turn(out.rotation(j)[50], b.rotation(j)[0]), 1e-15);
    EXPECT_LT(turn(out.rotation(j)[119], c.rotation(j)[29]), 1e-15);
  }
  EXPECT_EQ(out.translation(0)[50], b.translation(0)[0]);
}

TEST_F(Concatenate, aligned_walks_on_in_one_line_at_one_speed) {
  for (double blend : {0.0, 0.1, 0.25}) {
    auto node = concatenate({walk(100, 0.7, {1, 1, 2}), walk(80, -2, {-5, 1, 3}), walk(60, 3, {0, 1, 0})});
    const auto& out = node.set("blend", blend).run().out<Motion>("motion");
    auto overlap = static_cast<std::size_t>(blend * 120 + 0.5);
    ASSERT_EQ(out.frames(), 240 - 2 * overlap);
    for (std::size_t t = 0; t < out.frames(); ++t) {
      Vec3 straight = Vec3{1, 1, 2} + rotate(about_y(0.7), {0, 0, 1.5 * static_cast<double>(t) / 120});
      EXPECT_LT(norm(out.translation(0)[t] - straight), 1e-12) << blend << " " << t;
      EXPECT_LT(turn(out.rotation(0)[t], about_y(0.7)), 1e-12);
    }
  }
}

TEST_F(Concatenate, aligning_keeps_heights_poses_and_the_way_each_goes) {
  auto node = concatenate({a, b});
  const auto& out = node.run().out<Motion>("motion");
  Alone work;
  EncodedRoot whole = encode_root(out, work), second = encode_root(b, work);
  for (std::size_t t = 1; t < 40; ++t) {
    EXPECT_NEAR(whole.d_x[50 + t], second.d_x[t], 1e-9);
    EXPECT_NEAR(whole.d_z[50 + t], second.d_z[t], 1e-9);
    EXPECT_NEAR(whole.d_heading[50 + t], second.d_heading[t], 1e-9);
    EXPECT_NEAR(whole.height[50 + t], second.height[t], 1e-14);
    EXPECT_LT(turn(whole.rho[50 + t], second.rho[t]), 1e-13);
  }
}

TEST_F(Concatenate, fades_from_one_into_the_other) {
  auto node = concatenate({a, b});
  const auto& out = node.set("align", "none").set("blend", 0.1).run().out<Motion>("motion");  // 12 frames
  ASSERT_EQ(out.frames(), 78u);
  for (int j = 0; j < a.joints(); ++j) {
    EXPECT_LT(turn(out.rotation(j)[37], a.rotation(j)[37]), 1e-15);
    EXPECT_LT(turn(out.rotation(j)[50], b.rotation(j)[12]), 1e-15);
    double last = -1;
    for (std::size_t k = 0; k < 12; ++k) {
      double whole = turn(a.rotation(j)[38 + k], b.rotation(j)[k]);
      double part = turn(a.rotation(j)[38 + k], out.rotation(j)[38 + k]) / whole;
      EXPECT_GT(part, last);
      last = part;
    }
    EXPECT_GT(last, 0.95);
    for (std::size_t t = 1; t < 78; ++t) EXPECT_GT(dot(out.rotation(j)[t], out.rotation(j)[t - 1]), 0);
  }
}

TEST_F(Concatenate, joints_may_come_in_another_order_and_length) {
  Skeleton reordered;
  Skeleton s = sample_skeleton();
  std::vector<int> order = {0, 9, 10, 11, 12, 13, 14, 15, 16, 17, 1, 2, 3, 4, 5, 6, 7, 8};
  for (int j : order) {
    Joint joint = s.joints[j];
    if (joint.parent >= 0) joint.parent = reordered.find(s.joints[joint.parent].name);
    joint.offset *= 1.1;
    reordered.joints.push_back(joint);
  }
  Motion other = sample_motion(20, 120, 9, reordered);
  auto node = concatenate({a, other});
  const auto& out = node.set("align", "none").run().out<Motion>("motion");
  EXPECT_EQ(out.shared_skeleton(), node.out<Motion>("motion").shared_skeleton());
  EXPECT_EQ(out.skeleton().joints[1].name, "LeftUpLeg");
  EXPECT_LT(turn(out.rotation(1)[55], other.rotation(reordered.find("LeftUpLeg"))[5]), 1e-15);
}

TEST_F(Concatenate, refuses_other_joints_and_rates_and_overlaps_too_long) {
  Skeleton renamed = sample_skeleton();
  renamed.joints[5].name = "Tail";
  Diagnostic d = concatenate({a, sample_motion(9, 120, 1, renamed)}).refusal();
  EXPECT_EQ(d.code, "different-joints");
  EXPECT_EQ(d.port, "motions");
  EXPECT_EQ(d.joint, sample_skeleton().joints[5].name);

  Skeleton more = sample_skeleton();
  more.joints.push_back({"Tail", 0, {0, 0, -0.1}, {}});
  EXPECT_EQ(concatenate({a, sample_motion(9, 120, 1, more)}).refusal().joint, "Tail");
  Skeleton moved = sample_skeleton();
  moved.joints[moved.find("LeftArm")].parent = moved.find("Neck");
  EXPECT_EQ(concatenate({a, sample_motion(9, 120, 1, moved)}).refusal().joint, "LeftArm");

  EXPECT_EQ(concatenate({a, sample_motion(9, 60)}).refusal().code, "rate-mismatch");
  EXPECT_EQ(concatenate({a, sample_motion(9)}).set("blend", 0.1).refusal().code, "too-short");
}

TEST_F(Concatenate, forgets_the_angles_as_read) {
  SourceFacts source;
  source.read = std::make_shared<const std::vector<double>>(std::vector<double>(50));
  source.read_frames = 50;
  a.set_source(std::make_shared<const SourceFacts>(source));
  auto node = concatenate({a, b});
  EXPECT_EQ(node.run().out<Motion>("motion").source().read, nullptr);
}

TEST_F(Concatenate, motions_without_frames_add_none) {
  auto node = concatenate({sample_motion(0), a, sample_motion(0), sample_motion(1)});
  EXPECT_EQ(node.run().out<Motion>("motion").frames(), 51u);
}

}  // namespace
}  // namespace kinegraph
