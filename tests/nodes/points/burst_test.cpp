#include "nodes/points/burst.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

double mean_height(const Points& points, std::size_t t) {
  double sum = 0;
  for (int i = 0; i < int(points.labels.size()); ++i) sum += points.track(i)[t].y;
  return sum / double(points.labels.size());
}

TEST(Burst, IsTheSameForTheSameSeedOnly) {
  Alone work;
  BurstParams params;
  const std::string first = encoded(burst(params, work));
  EXPECT_EQ(first, encoded(burst(params, work)));
  params.seed = 1;
  EXPECT_NE(first, encoded(burst(params, work)));
}

TEST(Burst, BurstsFromOnePointThenRisesToItsHeightAndGirth) {
  Alone work;
  BurstParams params;
  params.seconds = 8;
  const Points points = burst(params, work);
  ASSERT_EQ(points.frames, 241u);
  double widest = 0;
  for (int i = 0; i < params.particles; ++i) {
    EXPECT_LT(norm(points.track(i)[0]), 1e-12);
    for (std::size_t t = 0; t < points.frames; ++t) {
      const Vec3 p = points.track(i)[t];
      EXPECT_GE(p.y, 0);
      widest = std::max(widest, std::hypot(p.x, p.z));
      if (t > 0) {
        EXPECT_LT(norm(p - points.track(i)[t - 1]) * params.fps, 3 * params.speed);
      }
    }
  }
  EXPECT_NEAR(widest, params.girth, 0.05 * params.girth);
  EXPECT_GT(mean_height(points, 240), 0.6 * params.rise);
  params.rise = 8;
  EXPECT_GT(mean_height(burst(params, work), 240), 1.5 * mean_height(points, 240));
}

TEST(Burst, FoldsOverInsideUpAndOutsideDown) {
  Alone work;
  BurstParams params;
  params.rise = 0;  // what is left is the folding
  const Points points = burst(params, work);
  double inside = 0, outside = 0;
  for (int i = 0; i < params.particles; ++i) {
    const Vec3 p = points.track(i)[60], q = points.track(i)[61];
    const double radius = std::hypot(p.x, p.z);
    if (p.y < 0.5) continue;
    (radius < 0.6 * params.girth ? inside : outside) += q.y - p.y;
  }
  EXPECT_GT(inside, 0);
  EXPECT_LT(outside, 0);
}

}  // namespace
}  // namespace kinegraph
