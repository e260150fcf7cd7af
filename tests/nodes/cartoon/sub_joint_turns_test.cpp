#include "nodes/cartoon/sub_joint_turns.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr double frame = 1.0 / 120, most = 20 / degrees_per_radian;

// Turns about x by the angles.
std::vector<Quat> about_x(const std::vector<double>& degrees) {
  std::vector<Quat> turns;
  for (double d : degrees) turns.push_back(axis_angle({1, 0, 0}, d / degrees_per_radian));
  return turns;
}
double degrees(Vec3 half) {
  return 2 * half.x * degrees_per_radian;
}

TEST(FollowedTurns, AreTheShortWayOfASingleTurn) {
  EXPECT_NEAR(degrees(followed_turns(about_x({200}), frame, most)[0]), -160, 1e-9);
  EXPECT_NEAR(degrees(followed_turns(about_x({-90}), frame, most)[0]), -90, 1e-9);
}

TEST(FollowedTurns, GoOnBeyondHalfATurnForAMoment) {
  std::vector<double> angles;
  for (int t = 0; t < 61; ++t) angles.push_back(230 - 4 * std::abs(t - 30));  // up to 230° and back
  const auto halves = followed_turns(about_x(angles), frame, most);
  for (std::size_t t = 0; t < angles.size(); ++t) EXPECT_NEAR(degrees(halves[t]), angles[t], 1e-9) << t;
}

TEST(FollowedTurns, ComeBackToTheShortWayWhenTheyStay) {
  std::vector<double> angles(240, 90.0);  // two seconds
  for (int t = 0; t < 60; ++t) angles.push_back(90 + 3 * t);
  for (int t = 0; t < 600; ++t) angles.push_back(267);  // for five seconds
  const auto halves = followed_turns(about_x(angles), frame, most);
  EXPECT_NEAR(degrees(halves[0]), 90, 1e-9);
  EXPECT_NEAR(degrees(halves.back()), -93, 1e-9);
  for (std::size_t t = 1; t < halves.size(); ++t)
    EXPECT_LE(2 * norm(halves[t] - halves[t - 1]), most + 1e-12) << t;
}

}  // namespace
}  // namespace kinegraph
