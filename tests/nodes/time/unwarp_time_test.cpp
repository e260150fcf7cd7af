#include "nodes/time/unwarp_time.h"

#include <gmock/gmock.h>

#include "nodes/motion/kinematics.h"
#include "nodes/time/frame_times.h"
#include "nodes/time/time_warp.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

// A walk on a curve whose timing makes the path both hold and skip frames, with a joint that slides.
Motion source_motion() {
  return with_sliding_joint(turning(bent(gait("walk", 3), 150, 0.75), 2.5), 5);
}
Motion reference_motion() {
  return bent(gait("walk", 3), 160, -0.75);
}

void expect_returns(const TimeWarpSettings& settings) {
  Alone work;
  const Motion source = source_motion();
  const TimeWarpResult result = time_warp(source, reference_motion(), settings, work);
  ASSERT_TRUE(result.warped);
  EXPECT_FALSE(result.warp.skipped.empty()) << "the test means to skip frames";
  const Motion back = unwarp_time(*result.warped, result.warp, work);
  ASSERT_EQ(back.frames(), source.frames());
  const Difference off = difference(back, source);
  EXPECT_LT(off.turn, 1e-6);
  EXPECT_LT(off.position, 1e-6);
}

TEST(UnwarpTime, ReturnsAnUneditedMotion) {
  expect_returns({});
}

TEST(UnwarpTime, ReturnsAnUneditedMotionWithOnePathADof) {
  TimeWarpSettings settings;
  settings.per_dof = true;
  expect_returns(settings);
}

TEST(UnwarpTime, NeedsWhatTheWarpKeptOfSkippedFrames) {
  Alone work;
  const Motion source = source_motion();
  TimeWarpResult result = time_warp(source, reference_motion(), {}, work);
  result.warp.skipped.clear();
  const Difference off = difference(unwarp_time(*result.warped, result.warp, work), source);
  EXPECT_GT(off.turn, 1e-4);
}

TEST(UnwarpTime, CarriesAnEditBackInTheSourcesTiming) {
  Alone work;
  const Motion source = source_motion();
  const TimeWarpResult result = time_warp(source, reference_motion(), {}, work);
  // Every joint is turned by a constant on its own side, as a transferred mean does, and the travel is
  // halved.
  const auto edited = [](const Motion& motion) {
    Alone alone;
    Motion out = motion;
    const Quat turned = axis_angle(normalized(Vec3{1, 2, 3}), 0.4);
    for (int j = 1; j < out.joints(); ++j) {
      const auto track = out.rotation(j);
      for (std::size_t f = 0; f < out.frames(); ++f) track.set(f, track[f] * turned);
    }
    EncodedRoot root = encode_root(motion, alone);
    for (double& d : root.d_x) d *= 0.5;
    for (double& d : root.d_z) d *= 0.5;
    decode_root(root, out);
    return out;
  };
  const Motion back = unwarp_time(edited(*result.warped), result.warp, work), direct = edited(source);
  const Difference off = difference(back, direct);
  EXPECT_LT(off.turn, 1e-6)
      << "what skipped frames miss is kept on the parent's side, which such an edit leaves alone";
  const EncodedRoot root = encode_root(back, work), wanted = encode_root(source, work);
  for (std::size_t f = 0; f < back.frames(); ++f) {
    ASSERT_NEAR(root.heading[f], wanted.heading[f], 1e-6) << f;
    ASSERT_LT(norm(back.local_offset(0, f) - direct.local_offset(0, f)), 0.05) << f;
  }
}

TEST(UnwarpTime, EnlargesWhatSkippedFramesMissAsTheEditEnlargedTheMotion) {
  Alone work;
  const Motion source = source_motion();
  const TimeWarpResult result = time_warp(source, reference_motion(), {}, work);
  const auto doubled = [](const Motion& motion) {
    Motion out = motion;
    for (int j = 1; j < out.joints(); ++j) {
      const auto track = out.rotation(j);
      for (std::size_t f = 0; f < out.frames(); ++f)
        track.set(f, slerp(2, motion.skeleton().joints[j].rest, track[f]));
    }
    return out;
  };
  const Motion direct = doubled(source);
  const double with = difference(unwarp_time(doubled(*result.warped), result.warp, work), direct).turn;
  Warp none = result.warp;
  none.skipped.clear();
  const double without = difference(unwarp_time(doubled(*result.warped), none, work), direct).turn;
  EXPECT_LT(with, 0.1 * without) << "adding what is missed as it was would leave half of it";
}

TEST(UnwarpTime, HoldsWhatFreeEndsLeftOff) {
  Alone work;
  Motion walk = turning(gait("walk", 3), 1.0);
  // The source has two frames at each end that the reference lacks.
  Motion reference = bent(walk, walk.frames(), 0.0);
  Motion source = walk.empty_like(walk.frames() - 2);
  for (int j = 0; j < walk.joints(); ++j) {
    for (std::size_t f = 0; f < source.frames(); ++f) {
      const std::size_t at = std::min(f < 2 ? std::size_t{90 - 10 * f} : f + 2, walk.frames() - 1);
      source.rotation(j).set(f, walk.rotation(j)[at]);
      if (walk.translates(j)) source.translation(j).set(f, walk.translation(j)[at]);
    }
  }
  TimeWarpSettings settings;
  settings.free_ends = true;
  const TimeWarpResult result = time_warp(source, reference, settings, work);
  const std::uint32_t first = result.warp.paths[0].front();
  ASSERT_GT(first, 0u);
  EXPECT_LT(norm(pose_at(*result.warped, 0).positions[0] - pose_at(source, first).positions[0]), 1e-9)
      << "the first row stands where its frame stood";
  Alone told;
  const Motion back = unwarp_time(*result.warped, result.warp, told);
  ASSERT_EQ(told.reported.size(), 1u);
  EXPECT_EQ(told.reported[0].code, "frames-left-off");
  for (std::size_t f = 0; f < back.frames(); ++f) {
    const std::size_t shown = std::clamp<std::size_t>(f, first, result.warp.paths[0].back());
    for (int j = 0; j < back.joints(); ++j)
      ASSERT_LT(turn(back.rotation(j)[f], source.rotation(j)[shown]), 1e-6) << f;
    ASSERT_LT(norm(back.local_offset(0, f) - source.local_offset(0, shown)), 1e-6) << f;
  }
}

TEST(UnwarpTime, PassesMotionsThroughTheIdentity) {
  Alone work;
  const Motion walk = gait("walk", 1);
  const Motion back = unwarp_time(walk, Warp(), work);
  EXPECT_LT(difference(back, walk).turn, 1e-12);
  EXPECT_EQ(back.frames(), walk.frames());
}

TEST(UnwarpTime, RefusesAMotionThatIsNotTheWarps) {
  Alone work;
  const Motion source = source_motion();
  const TimeWarpResult result = time_warp(source, reference_motion(), {}, work);
  try {
    unwarp_time(source, result.warp, work);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "wrong-length");
    EXPECT_EQ(failure.diagnostic().port, "motion");
  }
  Skeleton other;
  other.joints = {{"Hips"}};
  const Motion stranger(std::make_shared<Skeleton>(other), std::make_shared<SourceFacts>(), 60, 160, {true});
  EXPECT_THROW(unwarp_time(stranger, result.warp, work), Failure);
}

TEST(FrameTimes, AreCentresOfRunsAndLinearBetween) {
  const std::vector<std::uint32_t> path{1, 1, 1, 2, 5, 5};
  const FrameTimes times = frame_times(path, 7);
  EXPECT_THAT(times.row, testing::ElementsAre(0, 1, 3, testing::DoubleEq(3.5), testing::DoubleEq(4), 4.5, 5));
  EXPECT_TRUE(times.left_off(0));
  EXPECT_TRUE(times.left_off(6));
  EXPECT_TRUE(times.skipped(3));
  EXPECT_FALSE(times.skipped(5));
  const std::vector<double> rows{1, 2, 3, 10, 20, 40};
  EXPECT_THAT(averaged(rows, times, 0),
              testing::ElementsAre(2, 2, 10, testing::DoubleNear(16.6666666667, 1e-9),
                                   testing::DoubleNear(23.3333333333, 1e-9), 30, 30));
  EXPECT_EQ(averaged(rows, times, 1)[1], 2.5);
  EXPECT_EQ(sampled(rows, 3.5), 15);
  EXPECT_EQ(sampled(rows, 5), 40);
}

}  // namespace
}  // namespace kinegraph
