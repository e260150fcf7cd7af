#include "nodes/motion/encoded_root.h"

#include <gtest/gtest.h>

#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

class Root : public ::testing::Test {
 protected:
  Alone work;

  // A root that turns by `turns` whole turns, leaning and swaying, on a skeleton with fixed parents and a
  // rest rotation.
  static Motion turning(std::size_t frames, double turns) {
    Skeleton skeleton = sample_skeleton();
    skeleton.above = axis_angle({1, 0, 0}, -pi / 2);
    skeleton.above_offset = {1, 2, 3};
    skeleton.above_scale = 0.01;
    skeleton.joints[0].rest = axis_angle({1, 0, 0}, pi / 2) * about_y(0.4);
    Motion motion = sample_motion(frames, 60, 5, skeleton);
    auto q = motion.rotation(0);
    auto p = motion.translation(0);
    for (std::size_t t = 0; t < frames; ++t) {
      double s = static_cast<double>(t) / static_cast<double>(frames);
      Quat lean = axis_angle({1, 0, 0}, 0.3 * std::sin(9 * s)) * axis_angle({0, 0, 1}, 0.2 * std::cos(5 * s));
      Quat world = about_y(2 * pi * turns * s) * lean;
      q.set(t, inverse(skeleton.above) * world * (skeleton.above * skeleton.joints[0].rest));
      p.set(t, {100 * std::cos(4 * s), 90 + 200 * s * s, 10 * std::sin(20 * s)});
    }
    make_continuous(q.x, q.y, q.z, q.w);
    return motion;
  }
  static Vec3 world_position(const Motion& m, std::size_t t) {
    const Skeleton& s = m.skeleton();
    return s.above_offset + rotate(s.above, s.above_scale * m.translation(0)[t]);
  }
};

TEST_F(Root, decoding_what_was_encoded_gives_the_motion_back) {
  for (double turns : {0.0, 0.7, 3.0, -5.0}) {
    Motion motion = turning(500, turns);
    EncodedRoot root = encode_root(motion, work);
    for (auto decode : {decode_root, decode_root_keeping_heading}) {
      Motion back = motion.empty_like(500);
      decode(root, back);
      for (std::size_t t = 0; t < 500; ++t) {
        EXPECT_LT(norm(world_position(back, t) - world_position(motion, t)), 1e-12);
        EXPECT_LT(turn(back.rotation(0)[t], motion.rotation(0)[t]), 1e-12);
        if (t > 0) {
          EXPECT_GT(dot(back.rotation(0)[t], back.rotation(0)[t - 1]), 0.9);
        }
      }
    }
  }
  EXPECT_TRUE(work.reported.empty());
}

TEST_F(Root, the_heading_counts_whole_turns_and_is_zero_at_rest) {
  Motion motion = turning(500, 3);
  EncodedRoot root = encode_root(motion, work);
  double swept = root.heading.back() - root.heading.front();
  EXPECT_NEAR(swept, 2 * pi * 3 * 499 / 500, 0.1);  // leaning adds a little
  Motion rest = motion.empty_like(3);
  EXPECT_NEAR(encode_root(rest, work).heading[0], 0, 1e-15);
}

TEST_F(Root, travel_is_in_the_heading_frame_of_the_frame_before_per_second) {
  Motion motion = sample_motion(3, 50);
  auto q = motion.rotation(0);
  auto p = motion.translation(0);
  for (std::size_t t = 0; t < 3; ++t) {
    q.set(t, about_y(pi / 2 * static_cast<double>(t + 1)));
    p.set(t, {static_cast<double>(t), 1 + static_cast<double>(t), 0});
  }
  EncodedRoot root = encode_root(motion, work);
  // Facing x and moving along x: forwards. Facing -z and moving along x: to the right, which is -x of its
  // own.
  EXPECT_NEAR(root.d_z[1], 50, 1e-12);
  EXPECT_NEAR(root.d_x[1], 0, 1e-12);
  EXPECT_NEAR(root.d_z[2], 0, 1e-12);
  EXPECT_NEAR(root.d_x[2], -50, 1e-12);
  EXPECT_NEAR(root.d_heading[2], 50 * pi / 2, 1e-12);
  EXPECT_EQ(root.d_x[0], root.d_x[1]);
  EXPECT_EQ(root.d_z[0], root.d_z[1]);
  EXPECT_EQ(root.d_heading[0], root.d_heading[1]);
  EXPECT_EQ(root.height, (std::vector<double>{1, 2, 3}));
}

TEST_F(Root, turning_or_moving_the_whole_motion_changes_only_where_it_starts) {
  Motion motion = sample_motion(100), moved = motion;
  Quat turn_all = about_y(1.2);
  for (std::size_t t = 0; t < 100; ++t) {
    moved.rotation(0).set(t, turn_all * motion.rotation(0)[t]);
    moved.translation(0).set(t, rotate(turn_all, motion.translation(0)[t]) + Vec3{5, 0, -2});
  }
  EncodedRoot a = encode_root(motion, work), b = encode_root(moved, work);
  EXPECT_NEAR(b.start_heading - a.start_heading, 1.2, 1e-12);
  for (std::size_t t = 0; t < 100; ++t) {
    EXPECT_NEAR(a.d_x[t], b.d_x[t], 1e-11);
    EXPECT_NEAR(a.d_z[t], b.d_z[t], 1e-11);
    EXPECT_NEAR(a.d_heading[t], b.d_heading[t], 1e-11);
    EXPECT_LT(turn(a.rho[t], b.rho[t]), 1e-13);
  }
}

TEST_F(Root, rho_has_no_heading_of_its_own) {
  Motion motion = sample_motion(100);
  for (const Quat& rho : encode_root(motion, work).rho) EXPECT_NEAR(heading_of(rho), 0, 1e-13);
}

TEST_F(Root, a_somersault_is_warned_about_and_bridged) {
  Motion motion = sample_motion(361);
  for (std::size_t t = 0; t < 361; ++t)
    motion.rotation(0).set(t, about_y(0.5) * axis_angle({1, 0, 0}, static_cast<double>(t) * pi / 180));
  EncodedRoot root = encode_root(motion, work);
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "heading-singular");
  EXPECT_EQ(work.reported[0].frame, 176);
  EXPECT_EQ(work.reported[0].joint, "Hips");
  Motion back = motion.empty_like(361);
  decode_root(root, back);
  for (std::size_t t = 0; t < 361; ++t) {
    EXPECT_LT(turn(back.rotation(0)[t], motion.rotation(0)[t]), 1e-12);
    if (t > 0) {
      EXPECT_LT(std::fabs(root.heading[t] - root.heading[t - 1]), 0.5);
    }
  }
}

TEST_F(Root, head_down_throughout_has_heading_zero) {
  Motion motion = sample_motion(5);
  for (std::size_t t = 0; t < 5; ++t) motion.rotation(0).set(t, {1, 0, 0, 0});
  EXPECT_EQ(encode_root(motion, work).heading, std::vector<double>(5, 0.0));
}

TEST_F(Root, one_frame_and_none) {
  EncodedRoot one = encode_root(sample_motion(1), work);
  EXPECT_EQ(one.frames(), 1u);
  EXPECT_EQ(one.d_x[0], 0);
  EXPECT_EQ(encode_root(sample_motion(0), work).frames(), 0u);
}

}  // namespace
}  // namespace kinegraph
