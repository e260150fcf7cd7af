// Time warping on real clips: the pairs of [Wu, Table 1] as far as they are at hand.
#include <gtest/gtest.h>

#include "nodes/files/motion_file.h"
#include "nodes/time/dynamic_time_warp.h"
#include "nodes/time/time_warp.h"
#include "nodes/time/unwarp_time.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

Motion clip(const std::string& path, std::int64_t end = 0) {
  Alone work;
  PlainFiles files;
  ReadOptions options;
  options.drop_rest_frame = path.find("cmu/bvh/") != std::string::npos;
  options.fps = 120;
  if (end) options.range.end = end;
  return *read_motion_file(mocap(path), options, files, work).motion();
}

struct Pair {
  const char* source;
  const char* reference;
  std::int64_t reference_end;
};
const Pair pairs[] = {
    {"cmu/bvh/08_01.bvh", "cmu/asfamc/17_03.amc", 410},
    {"cmu/asfamc/16_45.amc", "cmu/bvh/08_07.bvh", 0},
    {"cmu/asfamc/16_31.amc", "cmu/bvh/104_HappyStartWalk_3.bvh", 0},
    {"cmu/asfamc/16_31.amc", "m21/OLD-1.bvh", 0},
};

void expect_sound(const Motion& source, const Motion& reference, const TimeWarpSettings& settings) {
  Alone work;
  const TimeWarpResult result = time_warp(source, reference, settings, work);
  const auto& energy = result.warp.energy;
  for (std::size_t i = 1; i < energy.size(); ++i) EXPECT_LE(energy[i], energy[i - 1] + 1e-12 * energy[0]);
  const std::size_t shorter = std::min(source.frames(), reference.frames());
  const std::size_t most = default_max_step(shorter, std::max(source.frames(), reference.frames()));
  for (const auto& path : result.warp.paths) {
    EXPECT_EQ(path.front(), 0u);
    EXPECT_EQ(path.back(), shorter - 1);
    std::size_t run = 1;
    for (std::size_t r = 1; r < path.size(); ++r) {
      ASSERT_GE(path[r], path[r - 1]);
      ASSERT_LE(path[r] - path[r - 1], most);
      run = path[r] == path[r - 1] ? run + 1 : 1;
      ASSERT_LE(run, most);
    }
  }
  const Motion& warped = result.warped ? *result.warped : source;
  const Difference off = difference(unwarp_time(warped, result.warp, work), source);
  EXPECT_LT(off.turn, 1e-6);
  EXPECT_LT(off.position, 1e-6);
}

class RealPairs : public testing::TestWithParam<Pair> {};

TEST_P(RealPairs, WarpWithinLimitsAtFallingEnergyAndComeBackInBothRoles) {
  KINEGRAPH_NEEDS_MOCAP();
  const Motion source = clip(GetParam().source),
               reference = clip(GetParam().reference, GetParam().reference_end);
  expect_sound(source, reference, {});
  expect_sound(reference, source, {});
}

TEST_P(RealPairs, WarpEachDofByItselfAndComeBackInBothRoles) {
  KINEGRAPH_NEEDS_MOCAP();
  const Motion source = clip(GetParam().source),
               reference = clip(GetParam().reference, GetParam().reference_end);
  TimeWarpSettings settings;
  settings.per_dof = true;
  settings.iterations = 3;
  expect_sound(source, reference, settings);
  expect_sound(reference, source, settings);
}

INSTANTIATE_TEST_SUITE_P(All, RealPairs, testing::ValuesIn(pairs), [](const auto& one) {
  std::string name = std::string(one.param.source) + "_on_" + one.param.reference;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace kinegraph
