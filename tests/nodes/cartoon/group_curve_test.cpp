#include "nodes/cartoon/group_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/motion/rotation.h"

namespace kinegraph {
namespace {

Vec3 point(const CurveWeights& weights, std::size_t row, const std::vector<Vec3>& joints) {
  Vec3 sum;
  for (std::size_t i = 0; i < joints.size(); ++i) sum += weights.rows[row * weights.joints + i] * joints[i];
  return sum;
}

// A joint as the limit of points on the links beside it, since a joint itself is not asked of the curve.
CurvePoint just_before(std::size_t joint) {
  return {joint - 1, 1 - 1e-12};
}

std::vector<Vec3> crooked(std::size_t joints) {
  std::vector<Vec3> all{{0, 0, 0}};
  for (std::size_t i = 1; i < joints; ++i) {
    const double a = static_cast<double>(i);
    all.push_back(all.back() + Vec3{0.3, 0.2 * std::sin(3 * a), 0.1 * std::cos(5 * a)});
  }
  return all;
}
std::vector<double> lengths(const std::vector<Vec3>& joints) {
  std::vector<double> all;
  for (std::size_t i = 1; i < joints.size(); ++i) all.push_back(norm(joints[i] - joints[i - 1]));
  return all;
}

TEST(GroupCurve, PassesThroughAllJoints) {
  for (std::size_t count = 2; count <= 12; ++count) {
    const auto joints = crooked(count);
    std::vector<CurvePoint> wanted;
    for (std::size_t i = 1; i < count; ++i) wanted.push_back(just_before(i));
    const auto weights = curve_weights(lengths(joints), wanted);
    for (std::size_t i = 1; i < count; ++i)
      EXPECT_LT(norm(point(weights, i - 1, joints) - joints[i]), 1e-9) << count << " joints, " << i;
  }
}

TEST(GroupCurve, IsTheBezierOfItsDegreeUpToFiveJoints) {
  // A polynomial of degree 4 in the chord length goes through itself.
  const std::vector<double> v{0.3, 0.1, 0.4, 0.2};
  const auto poly = [](double u) { return Vec3{u, u * u * u - u, 1 - u * u * u * u}; };
  std::vector<Vec3> joints;
  for (double u : {0.0, 0.3, 0.4, 0.8, 1.0}) joints.push_back(poly(u));
  const auto weights = curve_weights(v, std::vector<CurvePoint>{{0, 0.5}, {2, 0.25}, {3, 0.75}});
  EXPECT_LT(norm(point(weights, 0, joints) - poly(0.15)), 1e-12);
  EXPECT_LT(norm(point(weights, 1, joints) - poly(0.5)), 1e-12);
  EXPECT_LT(norm(point(weights, 2, joints) - poly(0.95)), 1e-12);
}

TEST(GroupCurve, IsSmoothWhereItIsSplit) {
  const auto joints = crooked(9);
  const auto v = lengths(joints);
  double total = 0;
  for (double one : v) total += one;
  const double e = 1e-5;
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    const auto weights = curve_weights(
        v, std::vector<CurvePoint>{{i - 1, 1 - e * total / v[i - 1]}, {i, 0}, {i, e * total / v[i]}});
    const Vec3 before = (point(weights, 1, joints) - point(weights, 0, joints)) / e;
    const Vec3 after = (point(weights, 2, joints) - point(weights, 1, joints)) / e;
    EXPECT_LT(norm(after - before), 0.02 * norm(before)) << i;
  }
}

TEST(GroupCurve, OfAStraightLimbIsStraight) {
  for (std::size_t count : {3u, 5u, 8u}) {
    std::vector<Vec3> joints;
    for (std::size_t i = 0; i < count; ++i)
      joints.push_back((0.1 + 0.3 * static_cast<double>(i * i % 3 + 2 * i)) * Vec3{0.6, 0.8, 0});
    const auto v = lengths(joints);
    const auto weights = curve_weights(v, std::vector<CurvePoint>{{0, 0.3}, {1, 0.5}, {count - 2, 0.9}});
    for (std::size_t r = 0; r < 3; ++r) {
      const Vec3 p = point(weights, r, joints);
      EXPECT_LT(norm(cross(p, Vec3{0.6, 0.8, 0})), 1e-12);
    }
    // At rest lengths a point also lies where it would on the straight link.
    EXPECT_LT(norm(point(weights, 0, joints) - (joints[0] + 0.3 * (joints[1] - joints[0]))), 1e-12);
  }
}

TEST(GroupCurve, MergesTinyLinks) {
  const std::vector<Vec3> joints{{0, 0, 0}, {0.5, 0.1, 0}, {0.5, 0.105, 0}, {1, 0, 0}, {1.2, 0.3, 0}};
  const auto v = lengths(joints);
  const auto weights = curve_weights(v, std::vector<CurvePoint>{{0, 0.5}, {2, 0.5}, {3, 0.5}});
  double largest = 0;
  for (double w : weights.rows) largest = std::max(largest, std::fabs(w));
  EXPECT_LT(largest, 2) << "knots close together would give huge weights";
  for (std::size_t r = 0; r < 3; ++r) {
    double sum = 0;
    for (std::size_t i = 0; i < 5; ++i) sum += weights.rows[r * 5 + i];
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(GroupCurve, TakesZeroLengths) {
  const auto weights = curve_weights(std::vector<double>{0, 0}, std::vector<CurvePoint>{{0, 0.5}, {1, 0.5}});
  for (double w : weights.rows) EXPECT_TRUE(w == 0 || w == 1);
}

}  // namespace
}  // namespace kinegraph
