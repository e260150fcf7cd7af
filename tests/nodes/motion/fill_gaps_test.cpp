#include "nodes/motion/fill_gaps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/motion/resample.h"

namespace kinegraph {
namespace {

Points wave(std::size_t frames) {
  Points points({"A"}, 120, frames);
  for (std::size_t t = 0; t < frames; ++t) {
    const double s = double(t) / 120;
    points.track(0).set(t, {std::sin(6 * s), 2 * s, std::cos(4 * s)});
  }
  return points;
}
void lose(Points& points, std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) points.set_missing(0, t);
}

TEST(FillGaps, GoesOnSmoothlyThroughShortGaps) {
  const Points whole = wave(200);
  Points points = whole;
  lose(points, 50, 60);
  lose(points, 63, 66);
  EXPECT_EQ(fill_gaps(points, 10), 13u);
  EXPECT_TRUE(points.missing.empty());
  for (std::size_t t = 0; t < 200; ++t)
    EXPECT_LT(norm(points.track(0)[t] - whole.track(0)[t]), (t >= 50 && t < 66) ? 1e-3 : 1e-300) << t;
}

TEST(FillGaps, KeepsLongGapsAndThoseAtTheEnds) {
  Points points = wave(100);
  lose(points, 0, 3);
  lose(points, 40, 51);
  lose(points, 60, 70);
  lose(points, 98, 100);
  EXPECT_EQ(fill_gaps(points, 10), 10u);
  EXPECT_TRUE(points.is_missing(0, 0) && points.is_missing(0, 45) && points.is_missing(0, 99));
  EXPECT_FALSE(points.is_missing(0, 65));
  EXPECT_EQ(gaps_of(points, 0).size(), 3u);
}

TEST(FillGaps, TakesAStraightLineBetweenTwoLoneSamples) {
  Points points({"A"}, 120, 3);
  points.track(0).set(0, {1, 0, 0});
  points.track(0).set(2, {3, 4, 0});
  lose(points, 1, 2);
  EXPECT_EQ(fill_gaps(points, 1), 1u);
  EXPECT_NEAR(norm(points.track(0)[1] - Vec3{2, 2, 0}), 0, 1e-15);
}

TEST(ResampledPoints, AreMissingWhereANeighbourIs) {
  Alone work;
  Points points = wave(20);
  lose(points, 8, 10);
  const Points finer = resampled(points, 240, work);
  ASSERT_EQ(finer.frames, 39u);
  EXPECT_EQ(finer.track(0)[12], points.track(0)[6]);
  for (std::size_t k : {15, 16, 17, 18, 19}) EXPECT_TRUE(finer.is_missing(0, k)) << k;
  EXPECT_FALSE(finer.is_missing(0, 14) || finer.is_missing(0, 20));
  EXPECT_NEAR(finer.track(0)[13].x, std::sin(6 * 6.5 / 120), 1e-5);
}

}  // namespace
}  // namespace kinegraph
