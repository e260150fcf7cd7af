// What Footskate makes of a walk that was changed after its plants were found: feet that point into the
// floor, legs that are too long for the height of the hips, feet that swing too low.
#include <gtest/gtest.h>

#include "nodes/feet/detect_contacts.h"
#include "nodes/feet/foot_points.h"
#include "nodes/feet/footskate.h"
#include "tests/nodes/feet/walks_and_runs.h"

namespace kinegraph {
namespace {

class RestyledFeet : public testing::Test {
 protected:
  void SetUp() override {
    walk_ = gait_motion("walk");
    Alone work;
    contacts_ = detect_contacts(walk_, {}, work);
    legs_ = find_legs(walk_.skeleton());
    ASSERT_EQ(legs_.size(), 2u);
  }
  FootskateResult cleaned(const Motion& motion) const {
    Alone work;
    return clean_footskate(motion, contacts_, {}, std::vector<double>(motion.frames(), 1), work);
  }
  // Turns a joint of both legs about its own sideways axis in every frame.
  Motion turned(int Leg::*joint, double angle) const {
    Motion out = walk_;
    for (const Leg& leg : legs_)
      for (std::size_t t = 0; t < out.frames(); ++t) {
        const auto track = out.rotation(leg.*joint);
        track.set(t, track[t] * axis_angle({1, 0, 0}, angle));
      }
    return out;
  }
  // Lowest ball in frames in which neither part of its foot is planted, between two stands.
  double lowest_swinging_ball(const Motion& motion) const {
    const WorldMotion world = world_motion(motion);
    double low = 1e9;
    for (const FootPoint& ball : contacts_.points) {
      if (ball.part != "ball") continue;
      const auto path = path_of(ball, world);
      std::vector<bool> free(motion.frames(), true);
      for (const FootPoint& other : contacts_.points)
        for (std::size_t t = 0; t < free.size(); ++t)
          if (other.foot == ball.foot && other.planted[t]) free[t] = false;
      for (const kinegraph::Run& swing : runs_of(free))
        for (std::size_t t = swing.start; swing.start > 0 && swing.end < free.size() && t < swing.end; ++t)
          low = std::min(low, path[t].y);
    }
    return low;
  }
  double lowest_plant() const {
    double low = 1e9;
    for (const FootPoint& point : contacts_.points)
      if (point.part == "ball")
        for (double height : point.heights) low = std::min(low, height);
    return low;
  }
  // Largest distance in height of planted points from the ground that the contacts know.
  double off_ground(const Motion& motion) const {
    const WorldMotion world = world_motion(motion);
    double off = 0;
    for (const FootPoint& point : contacts_.points) {
      const auto path = path_of(point, world);
      for (std::size_t i = 0; const kinegraph::Run& run : runs_of(point.planted)) {
        for (std::size_t t = run.start; t < run.end; ++t)
          off = std::max(off, std::fabs(path[t].y - point.heights[i]));
        ++i;
      }
    }
    return off;
  }

  Motion walk_;
  Contacts contacts_;
  std::vector<Leg> legs_;
};

TEST_F(RestyledFeet, StandFlatWhereTheStylePointsThemDown) {
  const Motion pointing = turned(&Leg::ankle, 0.25);
  ASSERT_GT(off_ground(pointing), 0.02) << "or nothing is asked";
  EXPECT_LT(off_ground(cleaned(pointing).motion), 0.004);
}

TEST_F(RestyledFeet, StandOnTheGroundWhereTheBodySankIntoIt) {
  Motion sunk = walk_;
  const auto root = sunk.translation(0);
  for (std::size_t t = 0; t < sunk.frames(); ++t) root.set(t, root[t] - Vec3{0, 0.12, 0});
  const FootskateResult result = cleaned(sunk);
  EXPECT_LT(off_ground(result.motion), 0.004);
  EXPECT_GT(result.largest_root_move, 0.1) << "the body goes up with them";
  EXPECT_LT(result.largest_stretch, 0.02) << "its legs stay as long as they were";
}

TEST_F(RestyledFeet, FollowTheHipsOfABodyThatFloats) {
  Motion floating = walk_;
  const auto root = floating.translation(0);
  for (std::size_t t = 0; t < floating.frames(); ++t) root.set(t, root[t] + Vec3{0, 0.12, 0});
  EXPECT_LT(off_ground(cleaned(floating).motion), 0.004);
}

TEST_F(RestyledFeet, SwingAboveTheirPlants) {
  const Motion low = turned(&Leg::ankle, 0.5);
  ASSERT_LT(lowest_swinging_ball(low), lowest_plant() - 0.03) << "or nothing is asked";
  EXPECT_GT(lowest_swinging_ball(cleaned(low).motion), lowest_plant() - 0.022);
}

TEST_F(RestyledFeet, KeepTheHeelOutOfTheFloorWhereTheBallAloneHolds) {
  for (FootPoint& point : contacts_.points)
    if (point.part == "heel") {
      point.planted.assign(point.planted.size(), false);
      point.heights.clear();
    }
  const Motion toes_up = turned(&Leg::ankle, -0.9), held = cleaned(toes_up).motion;
  const WorldMotion world = world_motion(held), once = world_motion(toes_up);
  double lowest = 1e9, jump = 0;
  for (const FootPoint& ball : contacts_.points)
    for (std::size_t t = 1; ball.part == "ball" && t + 1 < held.frames(); ++t) {
      const int ankle = held.skeleton().find(ball.foot);
      if (ball.planted[t]) lowest = std::min(lowest, world.position(ankle)[t].y);
      const auto path = [&](std::size_t at) {
        return point_at(world, ball.joint, ball.local, at) - point_at(once, ball.joint, ball.local, at);
      };
      jump = std::max(jump, norm(path(t - 1) - 2 * path(t) + path(t + 1)));
    }
  EXPECT_GT(lowest, contacts_.floor - 0.003);
  EXPECT_LT(jump * held.fps() * held.fps(), 150) << "m/s²";
}

// Weights of 0 leave a frame as it was, also where its foot swings low.
TEST_F(RestyledFeet, StayWhereTheChangeIsNotWanted) {
  const Motion low = turned(&Leg::ankle, 0.5);
  Alone work;
  std::vector<double> weights(low.frames(), 1);
  for (std::size_t t = 0; t < low.frames() / 2; ++t) weights[t] = 0;
  const Motion out = clean_footskate(low, contacts_, {}, weights, work).motion;
  const WorldMotion before = world_motion(low), after = world_motion(out);
  for (const Leg& leg : legs_)
    for (std::size_t t = 0; t < low.frames() / 2; ++t) {
      const Vec3 ankle = after.position(leg.ankle)[t] - before.position(leg.ankle)[t];
      // What the root carries of the other half is all.
      const Vec3 root = after.position(0)[t] - before.position(0)[t];
      ASSERT_LT(norm(ankle), 0.06 + norm(root)) << t;
      ASSERT_LT(turn(before.orientation(leg.ankle)[t], after.orientation(leg.ankle)[t]), 1e-6) << t;
    }
}

}  // namespace
}  // namespace kinegraph
