#include "nodes/feet/floor_clearance.h"

#include <gtest/gtest.h>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr double fps = 120, blend = 0.3;

// A foot of 0.15 m that hangs from an ankle 0.2 m high, in the plane of x = 0 turned by `yaw` about up; it
// points down from level by `depression` radians in each frame.
FootTrack hanging_foot(const std::vector<double>& depression, const std::vector<double>& yaw) {
  FootTrack foot;
  for (std::size_t t = 0; t < depression.size(); ++t) {
    foot.ankle.push_back({0, 0.2, 0});
    const Vec3 along{0, -0.15 * sine(depression[t]), 0.15 * cosine(depression[t])};
    foot.ball.from_ankle.push_back(rotate(about_y(yaw[t]), along));
  }
  return foot;
}
std::vector<Quat> turns_above(double height, const FootTrack& foot) {
  FloorLimits limits;
  limits.ball.assign(foot.frames(), height);
  AnkleTargets targets;
  targets.move.resize(foot.frames());
  targets.turn.resize(foot.frames());
  targets.held.assign(foot.frames(), false);
  raise_balls(foot, limits, fps, blend, std::vector<double>(foot.frames(), 1), targets);
  return targets.turn;
}
double largest_step(const std::vector<Quat>& turns) {
  double most = 0;
  for (std::size_t t = 1; t < turns.size(); ++t) most = std::max(most, turn(turns[t - 1], turns[t]));
  return most;
}

TEST(FloorClearance, RaisesABallToItsLimit) {
  const std::vector<double> down(60, 0.8), ahead(60, 0.4);
  const FootTrack foot = hanging_foot(down, ahead);
  const std::vector<Quat> turns = turns_above(0.12, foot);
  for (std::size_t t = 10; t < 50; ++t) {
    EXPECT_GT((foot.ankle[t] + rotate(turns[t], foot.ball.from_ankle[t])).y, 0.118) << t;
    EXPECT_LT((foot.ankle[t] + rotate(turns[t], foot.ball.from_ankle[t])).y, 0.125) << t;
  }
}

// Past straight down the shorter way up is the other one, which would turn the foot over within a frame.
TEST(FloorClearance, TurnsAFootToOneSideThatPassesStraightDown) {
  std::vector<double> down, ahead;
  for (int t = 0; t < 80; ++t) {
    down.push_back(1.2 + 0.6 * t / 80);  // 69° to 103°
    ahead.push_back(0.2 + 0.2 * t / 80);
  }
  const FootTrack foot = hanging_foot(down, ahead);
  const std::vector<Quat> turns = turns_above(0.12, foot);
  EXPECT_GT(turn(turns[60], {}), 0.3) << "or nothing is asked";
  EXPECT_LT(largest_step(turns), 0.05) << "rad from one frame to the next";
}

TEST(FloorClearance, GoesFromOneAxisToTheNextOverTheFramesBetween) {
  std::vector<double> down(60, 0.8), ahead(60, 0.0);
  for (std::size_t t = 20; t < 60; ++t) ahead[t] = 0.6;
  for (std::size_t t = 20; t < 40; ++t) down[t] = 0.2;  // nothing asked
  EXPECT_LT(largest_step(turns_above(0.12, hanging_foot(down, ahead))), 0.05);
}

TEST(FloorClearance, LeavesAloneWhatIsHighEnough) {
  const FootTrack foot = hanging_foot(std::vector<double>(20, 0.2), std::vector<double>(20, 0));
  for (const Quat& turned : turns_above(0.12, foot)) EXPECT_EQ(turned, Quat{});
}

}  // namespace
}  // namespace kinegraph
