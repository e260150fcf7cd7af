#include "nodes/style/travel_factor.h"

#include <gtest/gtest.h>

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
    Vec3 place = out.translation(0)[t];
    place.z = static_cast<double>(times) * motion.translation(0)[t / times].z;
    out.translation(0).set(t, place);
  }
  return out;
}

TEST(HoldsFrames, KnowsAMotionOnALongerClock) {
  EXPECT_FALSE(holds_frames(at_speed(1)));
  EXPECT_TRUE(holds_frames(held(at_speed(1), 2)));
  Alone work;
  Motion still(at_speed(1).shared_skeleton(), std::make_shared<SourceFacts>(), 120, 50, {});
  EXPECT_FALSE(holds_frames(still));
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
