#include "nodes/style/travel_factor.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/feet/detect_contacts.h"
#include "nodes/gait/gait.h"

namespace kinegraph {
namespace {

// A walk whose feet stand still, with its steps made longer or shorter.
Motion at_speed(double factor) {
  Alone work;
  Motion walk = make_gait({}, work);
  const Vec3Track path = walk.translation(0);
  for (double& z : path.z) z *= factor;
  for (double& x : path.x) x *= factor;
  return walk;
}

TEST(TravelFactor, BringsBackTheSpeedAtWhichFeetStandStill) {
  Alone work;
  const Contacts contacts = detect_contacts(at_speed(1), {}, work);
  EXPECT_NEAR(*travel_factor(at_speed(1), contacts, {}, work), 1, 1e-3);
  EXPECT_NEAR(*travel_factor(at_speed(0.5), contacts, {}, work), 2, 2e-3);
  EXPECT_NEAR(*travel_factor(at_speed(4), contacts, {}, work), 0.25, 1e-3);
  EXPECT_NEAR(*travel_factor(at_speed(-1), contacts, {}, work), -1, 1e-3);
}

TEST(TravelFactor, IsNotToBeHadWithoutPlantsOrTravel) {
  Alone work;
  Contacts contacts = detect_contacts(at_speed(1), {}, work);
  EXPECT_FALSE(travel_factor(at_speed(0), contacts, {}, work));
  EXPECT_FALSE(travel_factor(at_speed(1), contacts, std::vector<bool>(at_speed(1).frames(), false), work));
  EXPECT_FALSE(travel_factor(at_speed(1), Contacts{}, {}, work));
}

// Every frame shown `times` times over, the root going on with its step as TimeWarp has it.
Motion held(const Motion& motion, std::size_t times) {
  Motion out = motion.empty_like(motion.frames() * times);
  for (std::size_t t = 0; t < out.frames(); ++t) {
    for (int j = 0; j < motion.joints(); ++j) {
      out.rotation(j).set(t, motion.rotation(j)[t / times]);
      if (motion.translates(j)) out.translation(j).set(t, motion.translation(j)[t / times]);
    }
    const std::size_t frame = std::max<std::size_t>(1, t / times);
    Vec3 place = motion.translation(0)[t / times];
    const ConstVec3Track path = motion.translation(0);
    if (t > 0) place.z = out.translation(0)[t - 1].z + path[frame].z - path[frame - 1].z;
    out.translation(0).set(t, place);
  }
  return out;
}

TEST(FramesShown, LeavesOutWhatALongerClockHolds) {
  const Motion walk = at_speed(1);
  EXPECT_EQ(frames_shown(walk).size(), walk.frames());
  const std::vector<std::size_t> shown = frames_shown(held(walk, 2));
  ASSERT_EQ(shown.size(), walk.frames());
  for (std::size_t i = 0; i < shown.size(); ++i) EXPECT_EQ(shown[i], 2 * i);
  const Motion still(walk.shared_skeleton(), std::make_shared<SourceFacts>(), 120, 50, {});
  EXPECT_EQ(frames_shown(still).size(), 50u);
}

// TimeWarp repeats the delta of a frame that it holds.
TEST(PlantsOf, FindsThemOnALongerClock) {
  Alone work;
  const Motion walk = at_speed(1);
  const Contacts own = plants_of(walk, work), longer = plants_of(held(walk, 2), work);
  ASSERT_EQ(longer.frames, 2 * walk.frames());
  std::size_t planted = 0, differ = 0;
  for (std::size_t k = 0; k < own.points.size(); ++k) {
    for (std::size_t t = 0; t < walk.frames(); ++t) {
      planted += own.points[k].planted[t];
      differ += own.points[k].planted[t] != longer.points[k].planted[2 * t];
      EXPECT_EQ(longer.points[k].planted[2 * t], longer.points[k].planted[2 * t + 1]);
    }
  }
  EXPECT_GT(planted, 100u);
  EXPECT_LT(differ, planted / 20);
  EXPECT_TRUE(work.reported.empty());
}

// The walk with its hips' swing halved has about half the steps.
Motion with_half_the_swing(Motion walk) {
  for (const Leg& leg : find_legs(walk.skeleton())) {
    const QuatTrack hip = walk.rotation(leg.hip);
    for (std::size_t t = 0; t < walk.frames(); ++t) hip.set(t, slerp(0.5, Quat{}, hip[t]));
    const QuatTrack knee = walk.rotation(leg.knee);
    for (std::size_t t = 0; t < walk.frames(); ++t) knee.set(t, slerp(0.5, Quat{}, knee[t]));
  }
  return walk;
}

TEST(SweepFactor, IsOneForFeetThatDidNotChange) {
  Alone work;
  const Motion walk = at_speed(1);
  const Contacts contacts = detect_contacts(walk, {}, work);
  EXPECT_NEAR(*sweep_factor(walk, walk, contacts, {}, work), 1, 1e-12);
}

TEST(SweepFactor, IsTheSameOnALongerClock) {
  Alone work;
  const Motion walk = at_speed(1);
  const Motion shorter = with_half_the_swing(walk);
  const Contacts contacts = detect_contacts(walk, {}, work);
  const double plain = *sweep_factor(walk, shorter, contacts, {}, work);
  EXPECT_GT(plain, 0.3);
  EXPECT_LT(plain, 0.8);
  EXPECT_NEAR(*sweep_factor(held(walk, 3), held(shorter, 3), contacts, {}, work), plain, 0.03);
  EXPECT_NEAR(*travel_factor(shorter, contacts, {}, work), plain, 0.15);
}

}  // namespace
}  // namespace kinegraph
