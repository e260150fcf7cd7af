#include "nodes/motion/resample.h"

#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
namespace {

class Resample : public ::testing::Test {
 protected:
  Alone work;
};

TEST_F(Resample, is_exact_where_samples_coincide) {
  Motion motion = sample_motion(121, 120);
  for (double fps : {30.0, 60.0, 240.0, 360.0, 80.0}) {
    Motion out = resampled(motion, fps, work);
    EXPECT_EQ(out.fps(), fps);
    EXPECT_EQ(out.frames(), static_cast<std::size_t>(fps) + 1);
    for (std::size_t k = 0; k < out.frames(); ++k) {
      double at = static_cast<double>(k) * 120 / fps;
      if (at != std::floor(at)) continue;
      auto t = static_cast<std::size_t>(at);
      for (int j = 0; j < motion.joints(); ++j) EXPECT_LT(turn(out.rotation(j)[k], motion.rotation(j)[t]), 1e-15);
      EXPECT_EQ(out.translation(0)[k], motion.translation(0)[t]);
    }
  }
}

TEST_F(Resample, there_and_back_at_a_whole_multiple_is_the_motion_bit_for_bit) {
  Motion motion = sample_motion(50, 30);
  Motion back = resampled(resampled(motion, 120, work), 30, work);
  ASSERT_EQ(back.frames(), 50u);
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < 50; ++t) EXPECT_EQ(back.rotation(j)[t], motion.rotation(j)[t]);
}

TEST_F(Resample, turns_steadily_and_follows_cubics_between_samples) {
  Motion motion = sample_motion(31, 30);
  for (std::size_t t = 0; t < 31; ++t) {
    double s = static_cast<double>(t) / 30;
    motion.rotation(3).set(t, axis_angle({0, 0, 1}, 3 * s));
    motion.translation(0).set(t, {1 + 2 * s, 1 - s + 4 * s * s, -3 * s * s});
  }
  Motion out = resampled(motion, 77, work);
  for (std::size_t k = 0; k < out.frames(); ++k) {
    double s = static_cast<double>(k) / 77;
    EXPECT_NEAR(turn(out.rotation(3)[k], axis_angle({0, 0, 1}, 3 * s)), 0, 1e-14);
    // Catmull-Rom reproduces parabolas, also beside the ends.
    EXPECT_LT(norm(out.translation(0)[k] - Vec3{1 + 2 * s, 1 - s + 4 * s * s, -3 * s * s}), 1e-13);
  }
}

TEST_F(Resample, stays_close_to_a_smooth_motion) {
  Motion fine = sample_motion(481, 480), coarse = resampled(fine, 120, work),
         back = resampled(coarse, 480, work);
  for (int j = 0; j < fine.joints(); ++j)
    for (std::size_t t = 0; t < 481; ++t) {
      EXPECT_LT(turn(back.rotation(j)[t], fine.rotation(j)[t]), 1e-3);
      if (t > 0) {
        EXPECT_GT(dot(back.rotation(j)[t], back.rotation(j)[t - 1]), 0.99);
      }
    }
  for (std::size_t t = 0; t < 481; ++t)
    EXPECT_LT(norm(back.translation(0)[t] - fine.translation(0)[t]), 2e-6);
}

TEST_F(Resample, takes_a_frame_time_cut_short_for_the_rate_it_stands_for) {
  Motion motion = sample_motion(427, 1 / 0.008333);
  Motion out = resampled(motion, 120, work);
  EXPECT_EQ(out.fps(), 120);
  ASSERT_EQ(out.frames(), 427u);
  EXPECT_EQ(out.rotation(5)[426], motion.rotation(5)[426]);
  EXPECT_EQ(resampled(motion, 60, work).frames(), 214u);
}

TEST_F(Resample, forgets_the_angles_as_read_but_no_other_source_facts) {
  Motion motion = sample_motion(20, 120);
  SourceFacts source;
  source.unit = 0.01;
  source.read = std::make_shared<const std::vector<double>>(std::vector<double>(60));
  source.read_frames = 20;
  source.frame_time_text = "0.0083333";
  motion.set_source(std::make_shared<const SourceFacts>(source));
  Motion out = resampled(motion, 60, work);
  EXPECT_EQ(out.source().read, nullptr);
  EXPECT_EQ(out.source().read_frames, 0u);
  EXPECT_EQ(out.source().frame_time_text, "");
  EXPECT_EQ(out.source().unit, 0.01);
  EXPECT_EQ(resampled(motion, 120, work).source().read, source.read);
}

TEST_F(Resample, of_one_frame_is_that_frame_and_of_none_none) {
  EXPECT_EQ(resampled(sample_motion(1, 120), 7, work).frames(), 1u);
  EXPECT_EQ(resampled(sample_motion(2, 120), 7, work).frames(), 1u);
  EXPECT_EQ(resampled(sample_motion(2, 7), 120, work).frames(), 18u);
  EXPECT_EQ(resampled(sample_motion(0, 120), 7, work).frames(), 0u);
}

TEST_F(Resample, the_node_takes_its_rate_and_refuses_absurd_ones) {
  NodeInMemory node(*all_nodes().find("Resample"));
  node.link("motion", sample_motion(9, 120)).set("fps", 60).run();
  EXPECT_EQ(node.out<Motion>("motion").frames(), 5u);
  for (double fps : {0.0, -1.0, 1e9}) {
    NodeInMemory bad(*all_nodes().find("Resample"));
    EXPECT_EQ(bad.link("motion", sample_motion(9)).set("fps", fps).refusal().param, "fps");
  }
  NodeInMemory huge(*all_nodes().find("Resample"));
  EXPECT_EQ(huge.link("motion", sample_motion(30, 0.001)).set("fps", 100000.0).refusal().code,
            "too-many-frames");
}

}  // namespace
}  // namespace kinegraph
