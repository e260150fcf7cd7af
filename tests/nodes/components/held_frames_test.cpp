#include "nodes/components/held_frames.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kinegraph {
namespace {

// Two signals whose frame t shows moment `shown(t)` of a motion.
template <class Shown>
Rows signals(std::size_t frames, const Shown& shown) {
  Rows out(2, frames);
  for (std::size_t t = 0; t < frames; ++t) {
    const auto moment = static_cast<double>(shown(t));
    out(0, t) = std::sin(0.3 * moment);
    out(1, t) = std::cos(0.2 * moment);
  }
  return out;
}

TEST(OwnShareOfFrames, IsWholeWhereEveryFrameIsAnother) {
  EXPECT_EQ(own_share_of_frames(signals(100, [](std::size_t t) { return t; }), 30), 1);
}
TEST(OwnShareOfFrames, IsAThirdWhereEachFrameIsHeldForThree) {
  EXPECT_DOUBLE_EQ(own_share_of_frames(signals(99, [](std::size_t t) { return t / 3; }), 30), 1.0 / 3);
}
TEST(OwnShareOfFrames, LeavesOutARestThatNoWarpWouldMake) {
  const auto rests = [](std::size_t t) { return t < 50 ? t / 2 : t < 150 ? 25 : (t - 100) / 2; };
  EXPECT_DOUBLE_EQ(own_share_of_frames(signals(200, rests), 30), 0.5);
  EXPECT_EQ(own_share_of_frames(signals(100, [](std::size_t) { return 1; }), 30), 1) << "nothing moves";
}
// One signal that repeats while the other goes on holds nothing.
TEST(OwnShareOfFrames, AsksAllSignals) {
  Rows rows = signals(60, [](std::size_t t) { return t; });
  for (std::size_t t = 0; t < rows.columns; ++t) rows(1, t) = 0;
  EXPECT_EQ(own_share_of_frames(rows, 30), 1);
}

}  // namespace
}  // namespace kinegraph
