#include "nodes/motion/half_angle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kinegraph {
namespace {

TEST(AngleOverSine, IsThatOfTheAngleToTheLastDigits) {
  for (double angle = 1e-9; angle < 1.5707; angle = angle * 1.1 + 1e-5) {
    const double sine = std::sin(angle);
    const double expected = angle / sine;
    EXPECT_NEAR(angle_over_sine(sine * sine, std::cos(angle)), expected, 4 * 2.3e-16 * expected) << angle;
  }
}

TEST(AngleOverSine, HoldsAtBothEnds) {
  EXPECT_EQ(angle_over_sine(0, 1), 1);
  EXPECT_NEAR(angle_over_sine(1, 0), 1.5707963267948966, 4e-16);
}

}  // namespace
}  // namespace kinegraph
