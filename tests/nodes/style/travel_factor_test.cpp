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

}  // namespace
}  // namespace kinegraph
