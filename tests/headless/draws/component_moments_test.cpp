#include "headless/draws/component_moments.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

// Two clips of points, one component that rests but for what `set` does.
Components resting(std::size_t first, std::size_t second) {
  Components c;
  c.space.of_motions = false;
  c.space.labels = {"chin"};
  c.fps = 60;
  c.mean.assign(3, 0);
  c.mixing = Rows(3, 1);
  c.mixing(1, 0) = 1;
  c.signals = Rows(1, first + second);
  c.shares = {1};
  c.segments.push_back({0, first, nullptr, std::make_shared<const Points>(c.space.labels, 60, first), {}});
  c.segments.push_back(
      {first, first + second, nullptr, std::make_shared<const Points>(c.space.labels, 60, second), {}});
  return c;
}

TEST(ComponentMoments, AreEvenInEverySegment) {
  const Components c = resting(400, 800);
  const auto moments = even_moments(c);
  ASSERT_EQ(moments.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(moments[i].frame, 50 + 100 * i);
    EXPECT_EQ(moments[i].segment, i < 4 ? 0u : 1u);
    EXPECT_EQ(moments[i].own_frame, moments[i].frame - (i < 4 ? 0 : 400));
    EXPECT_NEAR(moments[i].part, (static_cast<double>(i) + 0.5) / 12, 1e-12);
  }
}

TEST(ComponentMoments, ShowWhatAComponentDoesBetweenThem) {
  Components c = resting(400, 800);
  const auto even = even_moments(c);
  for (std::size_t t = 610; t < 640; ++t) c.signals(0, t) = 4;   // a mouth that opens in the second clip
  for (std::size_t t = 170; t < 190; ++t) c.signals(0, t) = -2;  // and is pressed together in the first
  c.signals(0, 180) = -2.5;
  const auto telling = telling_moments(c, even, 0);
  ASSERT_EQ(telling.size(), even.size());
  for (std::size_t i = 0; i < even.size(); ++i) {
    EXPECT_EQ(telling[i].frame, i == 1 ? 180u : i == 6 ? 610u : even[i].frame) << i;
    EXPECT_EQ(telling[i].part, even[i].part);
  }
  EXPECT_EQ(telling[6].segment, 1u);
  EXPECT_EQ(telling[6].own_frame, 210u);
  // What a moment shows already isn't moved.
  for (std::size_t t = 600; t < 700; ++t) c.signals(0, t) = t == 610 ? 4 : 3.5;
  EXPECT_EQ(telling_moments(c, even, 0)[6].frame, 650u);
}

TEST(ComponentMoments, ShowBothDirectionsOneAfterTheOther) {
  Components c = resting(400, 800);
  const auto even = even_moments(c);
  c.signals(0, 602) = -4;
  c.signals(0, 615) = 4;  // both are nearest to the moment at 650
  const auto moments = telling_moments(c, even, 0);
  EXPECT_EQ(moments[5].frame, 602u);
  EXPECT_EQ(moments[6].frame, 615u);
  EXPECT_EQ(moments[4].frame, 450u);
  EXPECT_EQ(moments[7].frame, 750u);
}

// A gait of 100 frames a cycle, which a dozen moments would meet at one phase.
TEST(ComponentMoments, ShowMoreThanOnePhaseOfAGait) {
  Components c = resting(400, 800);
  for (std::size_t t = 0; t < c.frames(); ++t) c.signals(0, t) = sine(2 * pi * static_cast<double>(t) / 100);
  const auto moments = even_moments(c);
  EXPECT_NE(moments.size(), 12u);
  double low = 0, high = 0;
  for (const Moment& moment : telling_moments(c, moments, 0)) {
    low = std::min(low, c.signals(0, moment.frame));
    high = std::max(high, c.signals(0, moment.frame));
  }
  EXPECT_LT(low, -0.6);
  EXPECT_GT(high, 0.6);
}

TEST(ComponentMoments, AreNoneWithoutFrames) {
  const Components c = resting(0, 0);
  EXPECT_TRUE(even_moments(c).empty());
  EXPECT_TRUE(telling_moments(c, {}, 0).empty());
}

}  // namespace
}  // namespace kinegraph
