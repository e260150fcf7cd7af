#include "nodes/time/time_warp.h"

#include <gmock/gmock.h>

#include "nodes/time/features.h"
#include "nodes/time/unwarp_time.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

Diagnostic failure_of(const Motion& source, const Motion& reference, const TimeWarpSettings& settings) {
  Alone work;
  try {
    time_warp(source, reference, settings, work);
  } catch (const Failure& failure) {
    return failure.diagnostic();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(TimeWarp, LaysAShorterSourceOnTheReferencesClock) {
  Alone work;
  const Motion walk = gait("walk", 4), source = bent(walk, 190, 0.6), reference = bent(walk, 230, -0.4);
  const TimeWarpResult result = time_warp(source, reference, {}, work);
  ASSERT_TRUE(result.warped);
  EXPECT_FALSE(result.reference) << "the clock's own motion is untouched";
  EXPECT_TRUE(result.warp.source_warped);
  EXPECT_FALSE(result.warp.identity);
  ASSERT_EQ(result.warped->frames(), 230u);
  ASSERT_EQ(result.warp.paths.size(), 1u);
  ASSERT_EQ(result.warp.paths[0].size(), 230u);
  EXPECT_TRUE(result.warp.dofs.empty());
  // Both are the same walk, so the poses must now agree: within what a frame's step changes.
  double before = 0, after = 0;
  for (int j = 1; j < walk.joints(); ++j) {
    for (std::size_t f = 0; f < 230; ++f) {
      before += turn(source.rotation(j)[f * 189 / 229], reference.rotation(j)[f]);
      after += turn(result.warped->rotation(j)[f], reference.rotation(j)[f]);
    }
  }
  EXPECT_LT(after, 0.1 * before);
}

TEST(TimeWarp, LaysTheReferenceOnALongerSourcesClock) {
  Alone work;
  const Motion walk = gait("walk", 4), source = bent(walk, 230, 0.4), reference = bent(walk, 190, -0.6);
  const TimeWarpResult result = time_warp(source, reference, {}, work);
  EXPECT_FALSE(result.warped);
  ASSERT_TRUE(result.reference);
  EXPECT_FALSE(result.warp.source_warped);
  EXPECT_EQ(result.reference->frames(), 230u);
  EXPECT_TRUE(result.warp.skipped.empty());
  const Motion back = unwarp_time(source, result.warp, work);
  EXPECT_LT(difference(back, source).turn, 1e-12);
  EXPECT_EQ(difference(back, source).position, 0);
}

TEST(TimeWarp, GivesEqualLengthsTheSourcesClock) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const TimeWarpResult result = time_warp(walk, bent(walk, walk.frames(), 0.5), {}, work);
  EXPECT_FALSE(result.warp.source_warped);
  EXPECT_TRUE(result.reference);
}

TEST(TimeWarp, LeavesEqualMotionsAsTheyAre) {
  Alone work;
  const Motion walk = turning(gait("walk", 2), 1.0);
  const TimeWarpResult result = time_warp(walk, walk, {}, work);
  for (std::uint32_t r = 0; r < walk.frames(); ++r) ASSERT_EQ(result.warp.paths[0][r], r);
  EXPECT_LT(difference(*result.reference, walk).turn, 1e-7);
  EXPECT_LT(difference(*result.reference, walk).position, 1e-9);
}

TEST(TimeWarp, RepeatsAHeldFramesTravel) {
  Alone work;
  const Motion walk = turning(gait("walk", 3), 2.0), source = bent(walk, 120, 0.7),
               reference = bent(walk, 200, -0.5);
  const TimeWarpResult result = time_warp(source, reference, {}, work);
  const EncodedRoot from = encode_root(source, work), to = encode_root(*result.warped, work);
  const auto& path = result.warp.paths[0];
  for (std::size_t r = 1; r < path.size(); ++r) {
    ASSERT_NEAR(to.d_x[r], from.d_x[path[r]], 1e-9) << r;
    ASSERT_NEAR(to.d_z[r], from.d_z[path[r]], 1e-9) << r;
    ASSERT_NEAR(to.d_heading[r], from.d_heading[path[r]], 1e-9) << r;
    ASSERT_NEAR(to.height[r], from.height[path[r]], 1e-12) << r;
    ASSERT_LT(turn(to.rho[r], from.rho[path[r]]), 1e-7) << r;
  }
  EXPECT_NEAR(to.start_heading, from.start_heading, 1e-12);
  EXPECT_NEAR(norm(to.start - from.start), 0, 1e-12);
}

TEST(TimeWarp, EnergyFallsAndTheRoundsAreTold) {
  Alone work;
  const TimeWarpResult result = time_warp(gait("walk", 3), gait("sneak", 5), {}, work);
  const auto& energy = result.warp.energy;
  ASSERT_GE(energy.size(), 2u);
  for (std::size_t i = 1; i < energy.size(); ++i) EXPECT_LE(energy[i], energy[i - 1]);
  EXPECT_LT(energy.back(), energy.front());
  EXPECT_GE(result.warp.rounds, 1);
}

TEST(TimeWarp, PlainDynamicTimeWarpingIsOneSearch) {
  Alone work;
  TimeWarpSettings settings;
  settings.scale_and_offset = false;
  const TimeWarpResult result = time_warp(gait("walk", 3), gait("sneak", 5), settings, work);
  EXPECT_EQ(result.warp.rounds, 1);
  EXPECT_EQ(result.warp.energy.size(), 1u);
}

TEST(TimeWarp, EachDofMayHaveItsOwnPath) {
  Alone work;
  // The left arm of the source lags behind the rest of it.
  const Motion walk = gait("walk", 3);
  Motion source = bent(walk, 150, 0.0);
  const Motion late = bent(walk, 150, 0.7);
  const int arm = walk.skeleton().find("LeftArm");
  ASSERT_GE(arm, 0);
  for (std::size_t f = 0; f < 150; ++f) source.rotation(arm).set(f, late.rotation(arm)[f]);
  TimeWarpSettings settings;
  settings.per_dof = true;
  const TimeWarpResult result = time_warp(source, bent(walk, 170, 0.0), settings, work);
  const Warp& warp = result.warp;
  ASSERT_EQ(warp.paths.size(), warp.dofs.size());
  EXPECT_EQ(warp.dofs.back(), "*");
  EXPECT_EQ(warp.means.size(), 4u * static_cast<std::size_t>(walk.joints()));
  EXPECT_THAT(warp.dofs, testing::Contains("LeftArm.x"));
  EXPECT_THAT(warp.dofs, testing::Contains("root.height"));
  const auto arm_path = path_of_each_dof(warp, walk.skeleton())[static_cast<std::size_t>(3 * arm)];
  const auto leg_path = path_of_each_dof(
      warp, walk.skeleton())[static_cast<std::size_t>(3 * walk.skeleton().find("LeftUpLeg"))];
  EXPECT_NE(warp.paths[arm_path], warp.paths[leg_path]);
  ASSERT_TRUE(result.warped);
  EXPECT_EQ(result.warped->frames(), 170u);
  for (std::size_t i = 1; i < warp.energy.size(); ++i) EXPECT_LE(warp.energy[i], warp.energy[i - 1]);
}

TEST(TimeWarp, ComparesOnlyTheChosenFeatures) {
  Alone work;
  const Motion walk = gait("walk", 3);
  Motion source = bent(walk, 150, 0.0);
  const Motion late = bent(walk, 150, 0.7), reference = bent(walk, 170, 0.0);
  const int arm = walk.skeleton().find("LeftArm");
  for (std::size_t f = 0; f < 150; ++f) source.rotation(arm).set(f, late.rotation(arm)[f]);
  TimeWarpSettings legs;
  legs.features = "*Leg*,root";
  TimeWarpSettings one_dof;
  one_dof.features = "LeftArm.x";
  const auto path = time_warp(source, reference, legs, work).warp.paths[0];
  EXPECT_NE(path, time_warp(source, reference, one_dof, work).warp.paths[0]);
  for (std::size_t r = 0; r < path.size(); ++r) EXPECT_NEAR(path[r], static_cast<double>(r) * 149 / 169, 2.0);
}

TEST(TimeWarp, SpreadsFramesEvenlyWhereNothingMoves) {
  Alone work;
  const Motion walk = gait("walk", 1);
  const Motion still = walk.empty_like(30), longer = walk.empty_like(50);
  const TimeWarpResult result = time_warp(still, longer, {}, work);
  for (std::size_t r = 0; r < 50; ++r) EXPECT_EQ(result.warp.paths[0][r], r * 30 / 50);
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "nothing-moves");
  EXPECT_LT(difference(unwarp_time(*result.warped, result.warp, work), still).turn, 1e-7);
}

TEST(TimeWarp, TakesOneFrame) {
  Alone work;
  const Motion walk = gait("walk", 1), one = walk.empty_like(1);
  const TimeWarpResult shorter = time_warp(one, walk, {}, work);
  EXPECT_EQ(shorter.warped->frames(), walk.frames());
  EXPECT_LT(difference(unwarp_time(*shorter.warped, shorter.warp, work), one).turn, 1e-7);
  const TimeWarpResult longer = time_warp(walk, one, {}, work);
  EXPECT_EQ(longer.reference->frames(), walk.frames());
  const TimeWarpResult both = time_warp(one, one, {}, work);
  EXPECT_EQ(both.reference->frames(), 1u);
}

TEST(TimeWarp, RefusesWhatItCantDo) {
  const Motion walk = gait("walk", 2);
  TimeWarpSettings settings;
  settings.max_step = 2;
  const Diagnostic steps = failure_of(bent(walk, 30, 0), bent(walk, 100, 0), settings);
  EXPECT_EQ(steps.code, "does-not-fit");
  EXPECT_EQ(steps.param, "max_step");
  EXPECT_THAT(steps.hint, HasSubstr("4"));
  EXPECT_EQ(failure_of(walk.empty_like(0), walk, {}).port, "source");
  EXPECT_EQ(failure_of(walk, walk.empty_like(0), {}).port, "reference");
  settings = {};
  settings.features = "LeftUpLeg.q";
  EXPECT_EQ(failure_of(walk, walk, settings).param, "features");
  settings.features = "";
  EXPECT_EQ(failure_of(walk, walk, settings).code, "no-features");
}

TEST(ChosenDofs, ReadsJointsTheRootAndSingleDofs) {
  Alone work;
  Skeleton skeleton;
  skeleton.joints = {{"Hips"}, {"Spine", 0}, {"LeftUpLeg", 0}, {"LeftLeg", 2}};
  const auto names = [&](std::string_view pattern) {
    std::string all;
    const auto dofs = all_dofs(skeleton);
    const auto flags = chosen_dofs(pattern, skeleton, "features", work);
    for (std::size_t d = 0; d < dofs.size(); ++d)
      if (flags[d]) all += (all.empty() ? "" : " ") + name_of(dofs[d], skeleton);
    return all;
  };
  const std::string root = "root.travel_x root.travel_z root.height root.heading";
  EXPECT_EQ(names("LeftLeg"), "LeftLeg.x LeftLeg.y LeftLeg.z");
  EXPECT_EQ(names("LeftUpLeg.x, LeftLeg.z"), "LeftUpLeg.x LeftLeg.z");
  EXPECT_EQ(names("root"), root);
  EXPECT_EQ(names("root.height"), "root.height");
  EXPECT_EQ(names("LeftUpLeg>,-LeftLeg.y"), "LeftUpLeg.x LeftUpLeg.y LeftUpLeg.z LeftLeg.x LeftLeg.z");
  EXPECT_EQ(names("-*Leg,-root"), "Hips.x Hips.y Hips.z Spine.x Spine.y Spine.z");
  EXPECT_EQ(names("-root,-Hips,-Spine,-LeftLeg"), "LeftUpLeg.x LeftUpLeg.y LeftUpLeg.z");
  EXPECT_THROW(names("LeftUpLegs.x"), Failure);
}

}  // namespace
}  // namespace kinegraph
