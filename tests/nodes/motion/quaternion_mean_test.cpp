#include "nodes/motion/quaternion_mean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "nodes/motion/rotation.h"

namespace kinegraph {
namespace {

// Rotations as a track, in the order given.
class Track {
 public:
  explicit Track(const std::vector<Quat>& all) {
    for (Quat q : all) {
      x_.push_back(q.x);
      y_.push_back(q.y);
      z_.push_back(q.z);
      w_.push_back(q.w);
    }
  }
  ConstQuatTrack view() const { return {x_, y_, z_, w_}; }

 private:
  std::vector<double> x_, y_, z_, w_;
};

std::vector<Quat> scattered(int count, Quat around, double half_angle, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, half_angle / std::sqrt(3.0));
  std::vector<Quat> all;
  for (int i = 0; i < count; ++i)
    all.push_back(around * exp(Vec3{normal(random), normal(random), normal(random)}));
  return all;
}

// Independent of the code under test: power iteration on Σ q qᵀ.
Quat chordal_oracle(const std::vector<Quat>& all) {
  Quat v{0.1, 0.2, 0.3, 0.9};
  for (int i = 0; i < 20000; ++i) {
    Quat next{0, 0, 0, 0};
    for (Quat q : all) {
      const double d = dot(q, v);
      next = {next.x + d * q.x, next.y + d * q.y, next.z + d * q.z, next.w + d * q.w};
    }
    next = normalized(next);
    if (dot(next, v) > 1 - 1e-17) break;
    v = next;
  }
  return v;
}

double half_angle(Quat a, Quat b) {
  return std::acos(std::min(1.0, std::fabs(dot(a, b))));
}

Vec3 mean_log(Quat mean, const std::vector<Quat>& all) {
  Vec3 sum;
  for (Quat q : all) sum += log(nearer(inverse(mean) * q, Quat{}));
  return sum / static_cast<double>(all.size());
}

const Quat somewhere = normalized(Quat{0.3, -0.5, 0.2, 0.7});

TEST(KarcherMean, IsTheChordalMeanForSmallSpreads) {
  for (double spread : {1e-4, 1e-3, 1e-2}) {
    const auto all = scattered(200, somewhere, spread, 7);
    // They differ in the third order of the spread.
    EXPECT_LT(turn(karcher_mean(Track(all).view()).mean, chordal_oracle(all)), 2 * std::pow(spread, 3) + 1e-9)
        << spread;
  }
}

TEST(KarcherMean, HasLogsThatSumToZero) {
  for (double spread : {1e-6, 0.01, 0.1, 0.3, 0.6, 0.9}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const auto all = scattered(431, somewhere, spread, seed);
      const QuaternionMean found = karcher_mean(Track(all).view());
      EXPECT_LT(norm(mean_log(found.mean, all)), 2e-15) << spread;
      EXPECT_LT(found.residual, 2e-15) << spread;
    }
  }
}

TEST(KarcherMean, LeavesNoNearbyRotationWithLessSpread) {
  const auto all = scattered(100, somewhere, 0.5, 3);
  const QuaternionMean found = karcher_mean(Track(all).view());
  const auto square = [&](Quat mean) {
    double sum = 0;
    for (Quat q : all) sum += std::pow(half_angle(mean, q), 2);
    return sum / static_cast<double>(all.size());
  };
  EXPECT_NEAR(found.spread * found.spread, square(found.mean), 1e-12);
  for (Vec3 step : {Vec3{1e-3, 0, 0}, Vec3{-1e-3, 0, 0}, Vec3{0, 1e-3, 0}, Vec3{0, -1e-3, 0},
                    Vec3{0, 0, 1e-3}, Vec3{0, 0, -1e-3}}) {
    EXPECT_GT(square(found.mean * exp(step)), square(found.mean));
  }
}

TEST(KarcherMean, IsBlindToSignsAndToTheOrderOfFrames) {
  auto all = scattered(300, somewhere, 0.4, 11);
  const QuaternionMean straight = karcher_mean(Track(all).view());
  std::mt19937 random(5);
  std::shuffle(all.begin(), all.end(), random);
  for (std::size_t i = 0; i < all.size(); i += 3) all[i] = -all[i];
  const QuaternionMean shuffled = karcher_mean(Track(all).view());
  EXPECT_LT(turn(straight.mean, shuffled.mean), 1e-14);
  EXPECT_NEAR(straight.spread, shuffled.spread, 1e-14);
}

TEST(KarcherMean, TurnsWithTheRotations) {
  auto all = scattered(50, somewhere, 0.5, 2);
  const Quat before = karcher_mean(Track(all).view()).mean;
  const Quat left = normalized(Quat{0.1, 0.9, -0.3, 0.2});
  const Quat right = normalized(Quat{-0.6, 0.1, 0.3, 0.4});
  for (Quat& q : all) q = left * q * right;
  EXPECT_LT(turn(karcher_mean(Track(all).view()).mean, left * before * right), 1e-14);
}

TEST(KarcherMean, OfOneRotationIsThatRotation) {
  const QuaternionMean found = karcher_mean(Track({-somewhere}).view());
  EXPECT_LT(turn(found.mean, somewhere), 1e-15);
  EXPECT_LT(found.spread, 1e-15);
  EXPECT_GE(found.mean.w, 0);
}

TEST(KarcherMean, OfEqualRotationsHasNoSpread) {
  const QuaternionMean found = karcher_mean(Track(std::vector<Quat>(430, somewhere)).view());
  EXPECT_LT(turn(found.mean, somewhere), 1e-14);
  EXPECT_LT(found.spread, 1e-14);
}

TEST(KarcherMean, OfNothingIsTheIdentity) {
  EXPECT_EQ(karcher_mean(Track({}).view()).mean, Quat{});
  EXPECT_EQ(slerp_mean(Track({}).view()).mean, Quat{});
}

TEST(KarcherMean, StaysARotationWhereNoMeanStandsOut) {
  // Two opposite orientations; a full circle; orientations all over the sphere.
  std::vector<std::vector<Quat>> hard;
  hard.push_back({Quat{}, Quat{1, 0, 0, 0}});
  std::vector<Quat> circle;
  for (int i = 0; i < 360; ++i) circle.push_back(about_y(i * 3.14159265358979 / 180));
  hard.push_back(circle);
  std::vector<Quat> everywhere;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i)
    everywhere.push_back(normalized(Quat{normal(random), normal(random), normal(random), normal(random)}));
  hard.push_back(everywhere);
  for (const auto& all : hard) {
    const QuaternionMean found = karcher_mean(Track(all).view());
    EXPECT_NEAR(dot(found.mean, found.mean), 1, 1e-14);
    EXPECT_TRUE(std::isfinite(found.spread));
    EXPECT_LE(found.spread, 1.5708);
    EXPECT_EQ(found.mean, karcher_mean(Track(all).view()).mean);
  }
}

TEST(KarcherMean, SpreadOfARightAngleIsTheHalfAngle) {
  const QuaternionMean found = karcher_mean(Track({about_y(-0.5), about_y(0.5)}).view());
  EXPECT_LT(turn(found.mean, Quat{}), 1e-15);
  EXPECT_NEAR(found.spread, 0.25, 1e-15);
}

TEST(SlerpMean, IsTheRunningMeanOfAnglesAboutOneAxis) {
  std::vector<Quat> all;
  double sum = 0;
  for (int i = 0; i < 20; ++i) {
    const double angle = 0.8 * std::sin(0.7 * i) + 0.3;
    sum += angle;
    all.push_back(about_y(angle));
  }
  // Printed, the newest frame weighs (n−1)/n, which returns nearly the last one.
  EXPECT_LT(turn(slerp_mean(Track(all).view()).mean, about_y(sum / 20)), 1e-14);
  EXPECT_GT(turn(about_y(sum / 20), all.back()), 0.1);
}

TEST(SlerpMean, DependsOnTheOrderOfFrames) {
  auto all = scattered(40, somewhere, 0.6, 9);
  const Quat forwards = slerp_mean(Track(all).view()).mean;
  std::reverse(all.begin(), all.end());
  EXPECT_GT(turn(forwards, slerp_mean(Track(all).view()).mean), 1e-4);
}

}  // namespace
}  // namespace kinegraph
