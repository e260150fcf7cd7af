// StyleTransfer between every ordered pair of the CMU clips, which all have the same joints.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "nodes/style/style_transfer.h"
#include "nodes/time/time_warp.h"
#include "tests/nodes/feet/walks_and_runs.h"
#include "tests/nodes/style/cmu_clips.h"
#include "tests/nodes/style/independent_style_distance.h"

namespace kinegraph {
namespace {

constexpr double degrees = 57.29577951308232;

TEST(StyleTransferOnClips, GivesEveryJointOfEveryPairTheReferencesMeanAndSpread) {
  KINEGRAPH_NEEDS_MOCAP();
  const auto clips = all_cmu_clips();
  ASSERT_GE(clips.size(), 13u);
  std::vector<Stats> stats;
  Alone work;
  for (const auto& [name, motion] : clips) stats.push_back(quat_stats(motion, {}, work));

  int held = 0;
  for (std::size_t a = 0; a < clips.size(); ++a) {
    for (std::size_t b = 0; b < clips.size(); ++b) {
      if (a == b) continue;
      SCOPED_TRACE(clips[a].first + " <- " + clips[b].first);
      Alone told;
      StyleTransferParams printed;  // the path is no matter here
      printed.travel = TravelKind::printed;
      const StyleTransferResult result = style_transfer(clips[a].second, stats[b], &stats[a], printed, told);
      const Stats after = quat_stats(result.motion, {}, told);
      std::set<std::string> warned;
      for (const Diagnostic& d : told.reported) {
        if (d.code != "fold-over") continue;
        warned.insert(d.joint);
        EXPECT_TRUE(d.frame);
      }
      for (const JointGain& gain : result.gains) {
        const JointStats& got = after.joints[static_cast<std::size_t>(gain.joint)];
        const JointStats& wanted = stats[b].joints[static_cast<std::size_t>(gain.joint)];
        if (gain.gain * gain.largest_turn * degrees >= 170) {
          EXPECT_TRUE(warned.count(got.joint)) << got.joint;
          continue;
        }
        EXPECT_FALSE(warned.count(got.joint)) << got.joint;
        const bool root = gain.joint == 0;
        EXPECT_LT(turn(got.mean, wanted.mean) * degrees, root ? 0.1 : 0.05) << got.joint;
        const double own = stats[a].joints[static_cast<std::size_t>(gain.joint)].spread;
        if (own >= 0.001) {
          EXPECT_LT(std::fabs(got.spread / wanted.spread - 1), root ? 0.1 : 0.005) << got.joint;
        }
        ++held;
      }
    }
  }
  RecordProperty("joints", held);
  EXPECT_GT(held, 3684);
}

TEST(StyleTransferOnClips, WithTheRunningMeanComesWithinTwoDegrees) {
  KINEGRAPH_NEEDS_MOCAP();
  const Motion walk = cmu_clip("08_01");
  for (const char* name : {"07_01", "02_03", "08_07"}) {
    QuatStatsParams running;
    running.mean = MeanKind::slerp;
    Alone work;
    const Stats style = quat_stats(cmu_clip(name), running, work);
    const StyleTransferResult result = style_transfer(walk, style, nullptr, {}, work);
    const Stats after = quat_stats(result.motion, running, work);
    for (const JointGain& gain : result.gains) {
      if (gain.gain * gain.largest_turn * degrees >= 170) continue;
      const auto j = static_cast<std::size_t>(gain.joint);
      EXPECT_LT(turn(after.joints[j].mean, style.joints[j].mean) * degrees, 2)
          << name << " " << after.joints[j].joint;
    }
  }
}

TEST(StyleTransferOnClips, OfAWalkBringsItsStyleNearByIndependentMeasure) {
  KINEGRAPH_NEEDS_MOCAP();
  const Motion walk = cmu_clip("08_01");
  for (const char* name : {"08_07", "07_05"}) {
    Alone work;
    const Stats style = quat_stats(cmu_clip(name), {}, work);
    StyleTransferParams params;
    params.max_gain = 4;  // the node's default
    const StyleTransferResult result = style_transfer(walk, style, nullptr, params, work);
    const std::vector<int> partner = partners(walk.skeleton(), walk.skeleton(), {});
    const auto before = independent::style_distance(walk, style, partner);
    const auto after = independent::style_distance(result.motion, style, partner);
    EXPECT_GT(before.joints.size(), 20u);
    EXPECT_LT(after.mean, 0.05 * before.mean) << name;
  }
}

bool told_of(const Diagnostics& told, const char* code) {
  return std::any_of(told.begin(), told.end(), [&](const Diagnostic& one) { return one.code == code; });
}

// 16_45 runs: none of its feet rests for DetectContacts' 0.1 s.
TEST(StyleTransferOnClips, TravelsAsBeforeWhereARunnersFeetDoNotRest) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Motion run = clip("cmu/asfamc/16_45.amc"), stride = clip("cmu/bvh/08_07.bvh");
  const TimeWarpResult warped = time_warp(run, stride, {}, work);
  for (const Motion* motion : {&run, &*warped.warped}) {
    Alone told;
    const StyleTransferResult result =
        style_transfer(*motion, quat_stats(stride, {}, told), nullptr, StyleTransferParams{}, told);
    EXPECT_EQ(result.travel_factor, 1);
    EXPECT_TRUE(told_of(told.reported, "no-plants"));
    EXPECT_FALSE(told_of(told.reported, "travel-factor")) << "nothing was set by planted feet";
    EXPECT_FALSE(told_of(told.reported, "no-contacts"))
        << "DetectContacts' own message, and not on this node";
  }
}

}  // namespace
}  // namespace kinegraph
