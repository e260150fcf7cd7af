#include "nodes/feet/blending.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace kinegraph {
namespace {

constexpr double fps = 120, blend = 0.3, carried = 0.1;
constexpr double rate = 2 / (blend * fps);  // a frame, at which changes die away

struct Changes {
  std::vector<Vec3> change = std::vector<Vec3>(400);
  std::vector<bool> known = std::vector<bool>(400, false);
  void set(std::size_t t, Vec3 value) {
    change[t] = value;
    known[t] = true;
  }
  void fill() { fill_smoothly(change, known, fps, blend, carried); }
  double largest() const {
    double most = 0;
    for (Vec3 one : change) most = std::max(most, norm(one));
    return most;
  }
};

TEST(Blending, LeavesKnownFramesAndDiesAway) {
  Changes changes;
  const auto& change = changes.change;
  for (std::size_t t = 180; t < 220; ++t) changes.set(t, {0.05, 0, 0.001 * (static_cast<double>(t) - 200)});
  changes.fill();
  for (std::size_t t = 180; t < 220; ++t) EXPECT_EQ(change[t].x, 0.05);
  EXPECT_LT(norm(change[0]), 0.001);
  EXPECT_LT(norm(change[399]), 0.001);
  for (std::size_t t = 1; t + 1 < 400; ++t) {
    const Vec3 bend = change[t - 1] - 2 * change[t] + change[t + 1];
    EXPECT_LT(norm(bend) * fps * fps, 8) << "no kick where it begins, at " << t;
  }
}

TEST(Blending, KeepsZeroWhereNothingIsKnown) {
  Changes changes;
  std::fill(changes.change.begin(), changes.change.end(), Vec3{1, 1, 1});
  changes.fill();
  EXPECT_EQ(changes.largest(), 0);
}

TEST(Blending, TakesASingleKnownFrameForOneThatStandsStill) {
  Changes changes;
  changes.set(200, {0.2, 0.1, 0});
  changes.fill();
  EXPECT_NEAR(changes.largest(), norm(Vec3{0.2, 0.1, 0}), 1e-12);
}

// As of a foot that is lifted in the last frames that hold it.
TEST(Blending, CarriesAFastEndNotMuchFurtherThanItIs) {
  for (const double size : {0.3, 0.03})
    for (const bool mirrored : {false, true}) {
      Changes changes;
      for (std::size_t k = 0; k < 5; ++k)
        changes.set(mirrored ? 200 + k : 200 - k,
                    {size - 20 * rate * size * static_cast<double>(k) / 4, 0, 0});
      changes.fill();
      // The end at 200, on its outer side.
      double most = 0;
      for (std::size_t k = 0; k < 150; ++k)
        most = std::max(most, norm(changes.change[mirrored ? 200 - k : 200 + k]));
      EXPECT_LT(most, 1.3 * size + (size < carried ? carried : 0)) << size;
    }
}

TEST(Blending, RisesOverWhatIsNeededWithoutAKick) {
  std::vector<double> need(400, 0.0);
  for (std::size_t t = 190; t < 215; ++t) need[t] = 0.06;
  std::vector<bool> fixed(400, false);
  for (std::size_t t = 120; t < 150; ++t) fixed[t] = true;
  const std::vector<double> rise = rise_smoothly(need, fixed, 120, 0.3);
  for (std::size_t t = 120; t < 150; ++t) EXPECT_EQ(rise[t], 0);
  for (std::size_t t = 190; t < 215; ++t) EXPECT_GT(rise[t], 0.055) << t;
  for (std::size_t t = 1; t + 1 < 400; ++t)
    EXPECT_LT(std::abs(rise[t - 1] - 2 * rise[t] + rise[t + 1]) * 120 * 120, 25) << t;
  EXPECT_LT(std::abs(rise[399]), 0.001);
  for (double value : rise_smoothly(std::vector<double>(10, 0.0), std::vector<bool>(10, false), 120, 0.3))
    EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace kinegraph
