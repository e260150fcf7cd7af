#include "nodes/node_params.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

Params params(Json range, double fade, double amount) {
  return Params(Json::Object{{"range", std::move(range)}, {"fade", fade}, {"amount", amount}});
}
Json frames(std::int64_t start, std::int64_t end) {
  return Json::Array{start, end};
}
Json from(std::int64_t start) {
  return Json::Array{start, nullptr};
}

Diagnostic refusal(const FrameRange& range, std::size_t count) {
  try {
    checked_range(range, count, "range");
  } catch (const Failure& failure) {
    return failure.diagnostic();
  }
  return {};
}

TEST(Range, is_half_open_and_open_ended_to_the_end) {
  Frames all = checked_range({0, {}}, 10, "range");
  EXPECT_EQ(all.start, 0u);
  EXPECT_EQ(all.end, 10u);
  Frames last = checked_range({9, 10}, 10, "range");
  EXPECT_EQ(last.start, 9u);
  EXPECT_EQ(last.end, 10u);
}

TEST(Range, outside_the_motion_or_empty_is_refused_at_its_parameter) {
  for (FrameRange range :
       {FrameRange{10, {}}, FrameRange{0, 11}, FrameRange{5, 5}, FrameRange{6, 5}, FrameRange{-1, 5}}) {
    EXPECT_EQ(refusal(range, 10).code, "bad-range");
    EXPECT_EQ(refusal(range, 10).param, "range");
    EXPECT_NE(refusal(range, 10).hint.find("0 to 9"), std::string::npos);
  }
  const Diagnostic none = refusal({0, {}}, 0);
  EXPECT_EQ(none.code, "no-frames");
  EXPECT_EQ(none.message, "the motion has no frames");
  EXPECT_NE(none.hint.find(".amc"), std::string::npos) << "an .asf is a skeleton alone";
}

TEST(ChangeWeights, are_the_amount_throughout_without_a_range) {
  EXPECT_EQ(change_weights(params(from(0), 5, 0.5), 4, 30), std::vector<double>(4, 0.5));
}

TEST(ChangeWeights, without_a_fade_begin_and_end_with_the_range) {
  EXPECT_EQ(change_weights(params(frames(1, 3), 0, 1), 5, 30), (std::vector<double>{0, 1, 1, 0, 0}));
}

TEST(ChangeWeights, fade_smoothly_inside_the_range_the_same_at_both_ends) {
  auto w = change_weights(params(frames(20, 80), 0.1, 1), 100, 100);  // ten frames
  for (std::size_t t = 0; t < 100; ++t) {
    EXPECT_EQ(w[t] > 0, t >= 20 && t < 80) << t;
    EXPECT_EQ(w[t] == 1, t >= 30 && t < 70) << t;
    EXPECT_DOUBLE_EQ(w[t], w[99 - t]);
    if (t > 0) {
      EXPECT_LT(std::fabs(w[t] - w[t - 1]), 0.15);
    }
  }
  EXPECT_LT(w[20], 0.03);  // leaves zero without a corner
  EXPECT_NEAR(w[24] + w[25], 1, 0.1);
}

TEST(ChangeWeights, dont_fade_at_the_motions_own_ends) {
  auto w = change_weights(params(frames(0, 50), 0.1, 1), 100, 100);
  EXPECT_EQ(w[0], 1);
  EXPECT_LT(w[49], 0.05);
  w = change_weights(params(from(50), 0.1, 1), 100, 100);
  EXPECT_EQ(w[99], 1);
}

TEST(ChangeWeights, need_neither_fade_nor_amount) {
  EXPECT_EQ(change_weights(Params(Json::Object{{"range", from(1)}}), 3, 30), (std::vector<double>{0, 1, 1}));
}

TEST(BlendedChange, of_weight_zero_is_the_input_and_of_one_the_change_bit_for_bit) {
  Motion a = sample_motion(20, 120, 1), b = sample_motion(20, 120, 2);
  std::vector<bool> all(a.joints(), true);
  EXPECT_EQ(encoded(blended_change(a, b, all, std::vector<double>(20, 0))), encoded(a));
  EXPECT_EQ(encoded(blended_change(a, b, all, std::vector<double>(20, 1))), encoded(b));
  EXPECT_EQ(encoded(blended_change(a, b, std::vector<bool>(a.joints()), std::vector<double>(20, 1))),
            encoded(a));
}

TEST(BlendedChange, goes_by_slerp_and_moves_the_root_in_a_line) {
  Motion a = sample_motion(20, 120, 1), b = sample_motion(20, 120, 2);
  b.translation(0).x[5] += 1;
  std::vector<bool> all(a.joints(), true);
  Motion half = blended_change(a, b, all, std::vector<double>(20, 0.5));
  for (int j = 0; j < a.joints(); ++j) {
    double whole = turn(a.rotation(j)[7], b.rotation(j)[7]);
    EXPECT_NEAR(turn(a.rotation(j)[7], half.rotation(j)[7]), whole / 2, 1e-14);
    EXPECT_NEAR(turn(b.rotation(j)[7], half.rotation(j)[7]), whole / 2, 1e-14);
  }
  EXPECT_NEAR(half.translation(0).x[5], (a.translation(0).x[5] + b.translation(0).x[5]) / 2, 1e-15);
}

TEST(BlendedChange, leaves_joints_alone_that_werent_chosen_and_takes_on_new_tracks) {
  Motion a = sample_motion(20, 120, 1);
  Motion b = sample_motion(20, 120, 2).with_translation(2).with_translation(3);
  b.translation(2).y[4] = -1;
  std::vector<bool> joints(a.joints());
  joints[2] = true;
  Motion out = blended_change(a, b, joints, std::vector<double>(20, 1));
  EXPECT_TRUE(out.translates(2));
  EXPECT_FALSE(out.translates(3));
  EXPECT_EQ(out.translation(2).y[4], -1);
  EXPECT_EQ(out.rotation(2)[4], b.rotation(2)[4]);
  EXPECT_EQ(out.rotation(4)[4], a.rotation(4)[4]);
  EXPECT_EQ(out.translation(0)[4], a.translation(0)[4]);
}

TEST(SameRate, allows_for_frame_times_cut_short_and_names_resample) {
  check_same_rate(120, 1 / 0.008333, "motion", "other");
  check_same_rate(30, 1 / 0.033333, "motion", "other");
  for (double rate : {120.1, 60.0, 119.0}) {
    try {
      check_same_rate(120, rate, "motion", "other");
      ADD_FAILURE() << rate;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, "rate-mismatch");
      EXPECT_EQ(failure.diagnostic().port, "other");
      EXPECT_NE(failure.diagnostic().hint.find("Resample"), std::string::npos);
    }
  }
  EXPECT_THROW(check_same_rate(30, 30 / 1.001, "a", "b"), Failure);
}

TEST(Partners, alone_are_named_in_one_warning) {
  Skeleton s = sample_skeleton();
  auto partner = partners(s, s, {});
  partner[2] = partner[5] = -1;
  Alone work;
  warn_about_partners(s, s, partner, work);
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "no-partner");
  EXPECT_NE(work.reported[0].message.find(s.joints[5].name), std::string::npos);
}

TEST(Partners, with_other_rest_poses_are_warned_about_beyond_five_degrees) {
  Skeleton a = sample_skeleton(), b = a;
  auto turned_arm = [&](double degrees) {
    int forearm = b.find("LeftForeArm");
    b.joints[forearm].offset = rotate(axis_angle({0, 0, 1}, degrees * pi / 180), a.joints[forearm].offset);
    Alone work;
    warn_about_partners(a, b, partners(a, b, {}), work);
    return work.reported;
  };
  EXPECT_TRUE(turned_arm(0).empty());
  EXPECT_TRUE(turned_arm(4.9).empty());
  auto told = turned_arm(5.1);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, "rest-pose-differs");
  EXPECT_NE(told[0].message.find("LeftForeArm"), std::string::npos);
  EXPECT_NE(told[0].hint.find("Retarget"), std::string::npos);
}

}  // namespace
}  // namespace kinegraph
