#include "nodes/cartoon/swing_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

double turned(Vec3 a, Vec3 b) {
  return arc_tangent2(norm(cross(a, b)), dot(a, b));
}

constexpr double most_turn = 0.5;

struct Link {
  std::vector<Vec3> still, swung;
  std::vector<double> most;
  std::vector<Vec3> held() const { return hold_swing(still, swung, most, 1, 10); }
};

// A link that turns slowly, and swings as far and as fast as it likes.
Link wild(unsigned seed, double swing) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Link link;
  Vec3 away{};
  for (int t = 0; t < 200; ++t) {
    const double angle = 0.03 * t;
    link.still.push_back({std::sin(angle), -std::cos(angle), 0.2 * std::sin(0.1 * t)});
    away = 0.8 * away + swing * Vec3{normal(random), normal(random), normal(random)};
    link.swung.push_back(link.still.back() + away);
    link.most.push_back(most_turn);
  }
  return link;
}

TEST(HoldSwing, LeavesALinkAloneThatTurnsNoFasterThanItMay) {
  Link link = wild(1, 0.02);
  EXPECT_TRUE(link.held() == link.swung);
}

TEST(HoldSwing, LetsNoLinkTurnFasterThanItMayHoweverItSwings) {
  for (unsigned seed = 4; seed < 40; ++seed) {
    const Link link = wild(seed, 0.05 * seed);
    const std::vector<Vec3> held = link.held();
    EXPECT_TRUE(held != link.swung);
    for (std::size_t t = 0; t < held.size(); ++t) {
      ASSERT_GT(dot(held[t], link.still[t]), 0) << seed << " " << t;
      if (t == 0) continue;
      ASSERT_LE(turned(held[t - 1], held[t]), most_turn * (1 + 1e-9)) << seed << " " << t;
    }
  }
}

TEST(HoldSwing, SquashesWhatPointsBackAndKeepsTheLengthOfWhatIsTooFast) {
  Link link;
  for (int t = 0; t < 60; ++t) {
    link.still.push_back({0, 1, 0});
    link.swung.push_back(t < 30 ? Vec3{0.8, 0.6, 0} : Vec3{-0.8, 0.6, 0});
    link.most.push_back(most_turn);
  }
  const std::vector<Vec3> side = link.held();
  EXPECT_EQ(side[20], link.swung[20]);
  EXPECT_EQ(side[40], link.swung[40]);
  for (std::size_t t = 0; t < side.size(); ++t) EXPECT_NEAR(norm(side[t]), 1, 1e-12);
  // Half before, half after.
  EXPECT_NEAR(side[29].x, -side[30].x, 1e-9);
  for (Vec3& one : link.swung) one = {0.1, -2, 0};
  for (Vec3 one : link.held()) EXPECT_LT(norm(one - Vec3{0.1, 0.2, 0}), 1e-12);
}

TEST(HoldSwing, IsStillWhereTheStillLinkItselfHasNoDirection) {
  Link link = wild(3, 0.02);
  link.still[100] = -0.01 * link.still[99];
  link.swung[100] = link.still[100] + Vec3{0, 0, 0.7};
  const std::vector<Vec3> held = link.held();
  EXPECT_EQ(held[100], link.still[100]);
  EXPECT_EQ(held[80], link.swung[80]);
  link.still[100] = {};
  EXPECT_EQ(link.held()[100], (Vec3{}));
}

// What a finer step of the springs changes stays about as small, also where links are held.
TEST(HoldSwing, MovesLittleMoreThanWhatItIsGiven) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  double most = 0;
  for (unsigned seed = 1; seed < 40; ++seed) {
    Link link = wild(seed, 0.02 * seed);
    const std::vector<Vec3> before = link.held();
    double given = 0, came = 0;
    for (Vec3& one : link.swung) {
      const Vec3 change = 1e-6 * Vec3{normal(random), normal(random), normal(random)};
      given = std::max(given, norm(change));
      one += change;
    }
    const std::vector<Vec3> after = link.held();
    for (std::size_t t = 0; t < after.size(); ++t) came = std::max(came, norm(after[t] - before[t]));
    most = std::max(most, came / given);
  }
  EXPECT_LT(most, 5);
  RecordProperty("most", std::to_string(most));
}

TEST(SwingStep, IsNoneForASwingThatRidesAlong) {
  const Quat turns = axis_angle({0.3, 0.5, -0.2}, 0.4);
  const Vec3 still{0, 1, 0}, swung{0.4, 0.8, 0.3};
  // The smallest turn of the still link carries the swing.
  const Vec3 to = rotate(turns, still);
  EXPECT_NEAR(swing_step(still, swung, to, rotate(smallest_turn(still, to), swung)), 0, 1e-12);
  EXPECT_NEAR(swing_step(still, still, still, {std::sin(0.3), std::cos(0.3), 0}), 0.3, 1e-12);
}

}  // namespace
}  // namespace kinegraph
