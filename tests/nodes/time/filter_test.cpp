#include "nodes/time/filter.h"

#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/time/lowpass.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
namespace {

class Filter : public ::testing::Test {
 protected:
  Alone work;
  static constexpr std::size_t frames = 960;
  static double seconds(std::size_t t) { return static_cast<double>(t) / 120; }
  std::vector<bool> all = std::vector<bool>(sample_skeleton().joints.size(), true);

  // A joint that swings about one axis by `angle` at `frequency`.
  static Motion swinging(double angle, double frequency) {
    Motion motion = sample_motion(frames, 120);
    for (std::size_t t = 0; t < frames; ++t)
      motion.rotation(2).set(t, axis_angle({0.6, 0, 0.8}, angle * std::sin(2 * pi * frequency * seconds(t))));
    return motion;
  }
};

TEST_F(Filter, takes_from_a_swing_what_the_filter_takes_from_its_angle) {
  for (double angle : {0.1, 0.8, 1.5}) {
    for (double frequency : {1.0, 3.0, 6.0, 12.0}) {
      Motion motion = swinging(angle, frequency);
      for (auto method : {FilterSettings::Method::lowpass, FilterSettings::Method::gaussian}) {
        FilterSettings settings{method, 6, 2};
        Motion out = filtered(motion, all, settings, work);
        double ratio = method == FilterSettings::Method::lowpass
                           ? std::tan(pi * frequency / 120) / std::tan(pi * 6 / 120.0)
                           : 0;
        double gain = method == FilterSettings::Method::lowpass ? 1 / (1 + std::pow(ratio, 4))
                                                                : std::exp2(-frequency * frequency / 36);
        double worst = 0;
        for (std::size_t t = frames / 3; t < 2 * frames / 3; ++t) {
          double wished = gain * angle * std::sin(2 * pi * frequency * seconds(t));
          worst = std::max(worst, turn(out.rotation(2)[t], axis_angle({0.6, 0, 0.8}, wished)));
        }
        EXPECT_LT(worst, 0.01 * angle) << angle << " " << frequency << " " << static_cast<int>(method);
      }
    }
  }
}

TEST_F(Filter, leaves_steady_turning_and_travel_alone_up_to_the_ends) {
  Motion motion = sample_motion(frames, 120);
  for (std::size_t t = 0; t < frames; ++t) {
    motion.rotation(2).set(t, axis_angle({0.6, 0, 0.8}, 4 * seconds(t)));
    motion.translation(0).set(t, {seconds(t), 1, -2 * seconds(t)});
  }
  auto q = motion.rotation(2);
  make_continuous(q.x, q.y, q.z, q.w);
  for (auto method : {FilterSettings::Method::lowpass, FilterSettings::Method::gaussian}) {
    Motion out = filtered(motion, all, {method, 6, 2}, work);
    for (std::size_t t = 0; t < frames; ++t) {
      EXPECT_LT(turn(out.rotation(2)[t], motion.rotation(2)[t]), 1e-7) << t;
      EXPECT_LT(norm(out.translation(0)[t] - motion.translation(0)[t]), 1e-8) << t;
    }
  }
}

TEST_F(Filter, stays_smooth_and_unit_where_a_joint_turns_all_the_way_round) {
  Motion motion = sample_motion(frames, 120);
  for (std::size_t t = 0; t < frames; ++t)  // a cartwheel a second that rocks
    motion.rotation(2).set(t, axis_angle({0, 0, 1}, 2 * pi * seconds(t) + std::sin(30 * seconds(t))) *
                                  axis_angle({1, 0, 0}, std::sin(5 * seconds(t))));
  auto q = motion.rotation(2);
  make_continuous(q.x, q.y, q.z, q.w);
  Motion out = filtered(motion, all, {FilterSettings::Method::lowpass, 6, 2}, work);
  auto step = [](const Motion& m, std::size_t t) { return turn(m.rotation(2)[t - 1], m.rotation(2)[t]); };
  double before = 0, after = 0;
  for (std::size_t t = 1; t < frames; ++t) {
    before = std::max(before, step(motion, t));
    after = std::max(after, step(out, t));
    EXPECT_NEAR(dot(out.rotation(2)[t], out.rotation(2)[t]), 1, 1e-14);
  }
  EXPECT_LT(after, before);
}

TEST_F(Filter, filters_translations_as_the_plain_lowpass) {
  Motion motion = sample_motion(200, 120);
  auto p = motion.translation(0);
  for (std::size_t t = 0; t < 200; ++t) p.y[t] += t % 2 ? 0.01 : -0.01;
  Motion out = filtered(motion, all, {FilterSettings::Method::lowpass, 6, 3}, work);
  auto y = lowpass(motion.translation(0).y, 120, 6, 3);
  for (std::size_t t = 0; t < 200; ++t) EXPECT_EQ(out.translation(0).y[t], y[t]);
}

TEST_F(Filter, one_frame_and_none_pass) {
  EXPECT_EQ(filtered(sample_motion(1), all, {}, work).frames(), 1u);
  EXPECT_EQ(filtered(sample_motion(0), all, {}, work).frames(), 0u);
}

NodeInMemory filter() {
  return NodeInMemory(*all_nodes().find("Filter"));
}

TEST_F(Filter, the_node_keeps_to_its_joints_range_and_amount) {
  Motion motion = sample_motion(200, 120);
  for (int j = 0; j < motion.joints(); ++j)  // shake everything
    for (std::size_t t = 0; t < 200; ++t)
      motion.rotation(j).set(t, motion.rotation(j)[t] * axis_angle({1, 0, 0}, t % 2 ? 0.02 : -0.02));
  auto node = filter();
  node.link("motion", motion).set("joints", "LeftArm,Spine").set("range", Json::Array{50, 150}).run();
  const auto& out = node.out<Motion>("motion");
  int arm = motion.skeleton().find("LeftArm"), head = motion.skeleton().find("Head");
  EXPECT_EQ(out.rotation(arm)[49], motion.rotation(arm)[49]);
  EXPECT_GT(turn(out.rotation(arm)[50], motion.rotation(arm)[50]), 0.01);
  EXPECT_GT(turn(out.rotation(arm)[149], motion.rotation(arm)[149]), 0.01);
  EXPECT_EQ(out.rotation(arm)[150], motion.rotation(arm)[150]);
  EXPECT_EQ(out.rotation(head)[100], motion.rotation(head)[100]);
  EXPECT_EQ(out.translation(0)[100], motion.translation(0)[100]);

  auto none = filter();
  none.link("motion", motion).set("amount", 0.0).run();
  EXPECT_EQ(encoded(none.out<Motion>("motion")), encoded(motion));
}

TEST_F(Filter, the_node_says_when_nothing_can_be_taken_out) {
  auto node = filter();
  node.link("motion", sample_motion(20, 30)).set("cutoff", 15.0).run();
  ASSERT_EQ(node.reported().size(), 1u);
  EXPECT_EQ(node.reported()[0].code, "cutoff-too-high");
  EXPECT_EQ(encoded(node.out<Motion>("motion")), encoded(sample_motion(20, 30)));
}

TEST_F(Filter, the_node_refuses_what_is_no_pattern_joint_or_order) {
  EXPECT_EQ(filter().link("motion", sample_motion(20)).set("joints", "a,,b").refusal().code, "bad-pattern");
  EXPECT_EQ(filter().link("motion", sample_motion(20)).set("joints", "Tail").refusal().code, "unknown-joint");
  EXPECT_EQ(filter().link("motion", sample_motion(20)).set("order", 0).refusal().param, "order");
  EXPECT_EQ(filter().link("motion", sample_motion(20)).set("cutoff", 0).refusal().param, "cutoff");
  EXPECT_EQ(filter().link("motion", sample_motion(20)).set("range", Json::Array{30, nullptr}).refusal().param,
            "range");
}

}  // namespace
}  // namespace kinegraph
