#include "nodes/components/points_to_rotations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/motion/rotation.h"

namespace kinegraph {
namespace {

const std::vector<Vec3> directions = {{0.1, 1, 0.2}, {0.7, -0.3, 0.1}, {-0.6, -0.2, 0.4}};

std::vector<Vec3> turned(const std::vector<Vec3>& from, Quat q) {
  std::vector<Vec3> out;
  for (Vec3 v : from) out.push_back(rotate(q, v));
  return out;
}

TEST(BestRotation, FindsARotationFromAnyPrior) {
  for (double angle : {0.0, 1e-9, 0.3, 1.5, 3.0, 3.14159}) {
    const Quat wanted = axis_angle(normalized(Vec3{0.3, -0.8, 0.5}), angle);
    for (std::size_t count : {2, 3}) {
      const std::vector<Vec3> from(directions.begin(),
                                   directions.begin() + static_cast<std::ptrdiff_t>(count));
      for (Quat prior : {Quat{}, wanted, axis_angle({1, 0, 0}, 2.0)})
        EXPECT_LT(turn(best_rotation(from, turned(from, wanted), prior), wanted), 1e-6)
            << angle << ", " << count;
    }
  }
}

// No small turn of what was found brings the pairs nearer together.
TEST(BestRotation, LeavesTheLeastSumOfSquares) {
  const std::vector<Vec3> to = {{0.5, 0.9, -0.1}, {0.6, -0.5, 0.3}, {-0.2, -0.6, 0.3}};
  const auto sum = [&](Quat q) {
    double squares = 0;
    for (std::size_t i = 0; i < to.size(); ++i) {
      const Vec3 left = rotate(q, directions[i]) - to[i];
      squares += dot(left, left);
    }
    return squares;
  };
  const Quat best = best_rotation(directions, to, {});
  for (Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    for (double angle : {-1e-3, 1e-3, 1.0, 3.0}) EXPECT_GT(sum(best * axis_angle(axis, angle)), sum(best));
}

TEST(BestRotation, AimsWhatLiesAlongOneAxisByTheSmallestTurnOfThePrior) {
  const Quat prior = axis_angle(normalized(Vec3{1, 2, 3}), 1.1);
  const std::vector<Vec3> from = {{0.2, 0, 0}, {-0.3, 0, 0}};
  EXPECT_LT(turn(best_rotation(from, turned(from, prior), prior), prior), 1e-7);
  const Quat tilt = axis_angle({0, 0, 1}, 0.4);  // square to the axis
  EXPECT_LT(turn(best_rotation(from, turned(from, prior * tilt), prior), prior * tilt), 1e-7);
}

}  // namespace
}  // namespace kinegraph
