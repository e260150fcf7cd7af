#include "nodes/judge/spectral_arc_length.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace kinegraph {
namespace {

constexpr double pi = 3.14159265358979323846;

// The paper's code, step by step, with a transform by definition.
double by_definition(const std::vector<double>& speed, double fps) {
  std::size_t padded = 1;
  while (padded < speed.size()) padded *= 2;
  padded *= 16;
  std::vector<double> frequency, magnitude;
  for (std::size_t k = 0; k < padded; ++k) {
    const double f = fps * static_cast<double>(k) / static_cast<double>(padded);
    if (f > 10) break;
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < speed.size(); ++n) {
      sum += speed[n] *
             std::polar(1.0, -2 * pi * static_cast<double>(k * n % padded) / static_cast<double>(padded));
    }
    frequency.push_back(f);
    magnitude.push_back(std::abs(sum));
  }
  const double top = *std::max_element(magnitude.begin(), magnitude.end());
  for (double& m : magnitude) m /= top;
  std::size_t last = 0;
  for (std::size_t k = 0; k < magnitude.size(); ++k) {
    if (magnitude[k] >= 0.05) last = k;
  }
  double length = 0;
  for (std::size_t k = 1; k <= last; ++k) {
    length +=
        std::hypot((frequency[k] - frequency[k - 1]) / frequency[last], magnitude[k] - magnitude[k - 1]);
  }
  return -length;
}

// A minimum-jerk reach of one second, as speed.
std::vector<double> reach(double fps, double seconds = 1) {
  std::vector<double> speed;
  for (double t = 0; t <= seconds; t += 1 / fps) {
    const double s = t / seconds;
    speed.push_back(30 * s * s * (1 - s) * (1 - s));
  }
  return speed;
}

TEST(SpectralArcLength, IsThePapers) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t samples : {2u, 3u, 17u, 64u, 65u, 300u}) {
    std::vector<double> speed(samples);
    for (double& v : speed) v = uniform(random);
    EXPECT_NEAR(*SpectralArcLength(samples, 120)(speed), by_definition(speed, 120), 1e-12) << samples;
  }
}

TEST(SpectralArcLength, OfASingleSmoothReachIsTheKnownFigure) {
  const auto speed = reach(120);
  // Reported for a minimum-jerk movement: about −1.4.
  EXPECT_NEAR(*SpectralArcLength(speed.size(), 120)(speed), -1.41, 0.03);
}

TEST(SpectralArcLength, FallsWithEverySubMovement) {
  std::vector<double> speed;
  double before = 0;
  for (int count = 1; count <= 4; ++count) {
    const auto one = reach(120, 0.5);
    speed.insert(speed.end(), one.begin(), one.end());
    speed.insert(speed.end(), 30, 0.0);
    const double now = *SpectralArcLength(speed.size(), 120)(speed);
    EXPECT_LT(now, before - 0.1);
    before = now;
  }
}

TEST(SpectralArcLength, DoesNotDependOnTheSizeOfTheMovement) {
  auto speed = reach(120);
  const SpectralArcLength measure(speed.size(), 120);
  const double before = *measure(speed);
  for (double& v : speed) v *= 37;
  EXPECT_NEAR(*measure(speed), before, 1e-12);
}

TEST(SpectralArcLength, IsMissingForAPointAtRestOrASingleSample) {
  EXPECT_FALSE(SpectralArcLength(50, 120)(std::vector<double>(50, 0.0)));
  EXPECT_FALSE(SpectralArcLength(50, 120)(std::vector<double>(50, 1e-15)));
  EXPECT_FALSE(SpectralArcLength(1, 120)(std::vector<double>(1, 1.0)));
  EXPECT_FALSE(SpectralArcLength(0, 120)({}));
}

}  // namespace
}  // namespace kinegraph
