#include "nodes/time/iterative_motion_warp.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "nodes/time/space_warp.h"

namespace kinegraph {
namespace {

// Sums of slow waves, as joints move.
Series waves(std::size_t frames, std::size_t dims, unsigned seed, double speed = 1) {
  std::mt19937 generator(seed);
  const auto unit = [&] { return generator() / 4294967296.0; };
  Series series(frames, dims);
  for (std::size_t d = 0; d < dims; ++d) {
    const double phase = unit(), second = unit(), offset = unit(), noise = 0.02;
    for (std::size_t f = 0; f < frames; ++f) {
      const double t = speed * static_cast<double>(f);
      series.dim(d)[f] =
          offset + std::sin(0.11 * t + phase) + 0.5 * std::sin(0.05 * t + 6 * second) + noise * unit();
    }
  }
  return series;
}

TEST(SpaceWarp, SolvesEquation3) {
  const std::size_t frames = 23, rows = 31;
  const Series s = waves(frames, 1, 1), r = waves(rows, 1, 2);
  std::vector<std::uint32_t> path(rows);
  for (std::size_t i = 0; i < rows; ++i)
    path[i] = static_cast<std::uint32_t>(i * (frames - 1) / (rows - 1) / 2 * 2);
  path.back() = frames - 1;  // every second frame is skipped
  const SpaceWarpWeights weights{0.7, 2.5, 1e-3};

  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(rows, frames), first = Eigen::MatrixXd::Zero(frames - 1, frames);
  for (std::size_t i = 0; i < rows; ++i) w(i, path[i]) = 1;
  for (std::size_t i = 0; i + 1 < frames; ++i) {
    first(i, i) = -1;
    first(i, i + 1) = 1;
  }
  const Eigen::VectorXd sv = Eigen::Map<const Eigen::VectorXd>(s.values.data(), frames);
  const Eigen::VectorXd rv = Eigen::Map<const Eigen::VectorXd>(r.values.data(), rows);
  const Eigen::MatrixXd ws = w * sv.asDiagonal(), smooth = first.transpose() * first;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(frames, frames);
  Eigen::MatrixXd left(2 * frames, 2 * frames);
  left << ws.transpose() * ws + 0.7 * 0.7 * smooth + 1e-3 * one, ws.transpose() * w, w.transpose() * ws,
      w.transpose() * w + 2.5 * 2.5 * smooth + 1e-3 * one;
  Eigen::VectorXd right(2 * frames);
  right << ws.transpose() * rv + 1e-3 * Eigen::VectorXd::Ones(frames), w.transpose() * rv;
  const Eigen::VectorXd expected = left.ldlt().solve(right);

  std::vector<double> a(frames, 1.0), b(frames, 0.0);
  const double before = space_warp_energy(s.dim(0), r.dim(0), path, weights, a, b);
  EXPECT_GT(solve_space_warp(s.dim(0), r.dim(0), path, weights, a, b), 0);
  EXPECT_LT(space_warp_energy(s.dim(0), r.dim(0), path, weights, a, b), before);
  for (std::size_t i = 0; i < frames; ++i) {
    EXPECT_NEAR(a[i], expected(i), 1e-10) << i;
    EXPECT_NEAR(b[i], expected(frames + i), 1e-10) << i;
  }
  EXPECT_NEAR(solve_space_warp(s.dim(0), r.dim(0), path, weights, a, b), 0, 1e-10)
      << "it is at the minimum already";
}

TEST(SpaceWarp, StaysSoundWithHugeWeightsAndWithNone) {
  const Series s = waves(400, 1, 3), r = waves(400, 1, 4);
  std::vector<std::uint32_t> path(400);
  for (std::uint32_t i = 0; i < 400; ++i) path[i] = i;
  for (double weight : {0.0, 1e-6, 1.0, 1e3, 1e6}) {
    const SpaceWarpWeights weights{weight, weight, 1e-9};
    std::vector<double> a(400, 1.0), b(400, 0.0);
    const double start = space_warp_energy(s.dim(0), r.dim(0), path, weights, a, b);
    solve_space_warp(s.dim(0), r.dim(0), path, weights, a, b);
    const double once = space_warp_energy(s.dim(0), r.dim(0), path, weights, a, b);
    solve_space_warp(s.dim(0), r.dim(0), path, weights, a, b);
    EXPECT_NEAR(space_warp_energy(s.dim(0), r.dim(0), path, weights, a, b), once, 1e-6 * once + 1e-12 * start)
        << weight;
    if (weight == 0) {
      EXPECT_LT(once, 1e-6);
    }
    if (weight < 1e6) continue;
    // Nothing may bend: a and b are those of a straight line fit of r on s.
    double ss = 0, sr = 0, sum_s = 0, sum_r = 0;
    for (std::size_t i = 0; i < 400; ++i) {
      ss += s.values[i] * s.values[i];
      sr += s.values[i] * r.values[i];
      sum_s += s.values[i];
      sum_r += r.values[i];
    }
    const double slope = (400 * sr - sum_s * sum_r) / (400 * ss - sum_s * sum_s);
    for (double value : a) EXPECT_NEAR(value, slope, 1e-5);
    for (double value : b) EXPECT_NEAR(value, (sum_r - slope * sum_s) / 400, 1e-5);
  }
}

// The last half-step is told of, too, whether it was taken or not: so a search that finds a worse path shows.
void expect_never_rises(const std::vector<double>& energy, const Series& clock, const std::string& of) {
  double squares = 0;
  for (double value : clock.values) squares += value * value;
  ASSERT_GE(energy.size(), 2u) << of;
  for (std::size_t i = 1; i < energy.size(); ++i)
    EXPECT_LE(energy[i], energy[i - 1] + 1e-12 * energy[0] + 1e-20 * squares)
        << "half-step " << i << ", " << of;
}

TEST(IterativeMotionWarp, NeverRaisesItsEnergy) {
  Alone work;
  unsigned seed = 10;
  for (auto [frames, rows] :
       {std::pair{2u, 3u}, {9u, 25u}, {60u, 60u}, {61u, 170u}, {120u, 140u}, {300u, 301u}}) {
    const std::size_t most = default_max_step(frames, rows);
    for (double smoothness : {0.0, 0.5, 5.0, 50.0, 1e4}) {
      for (bool free_ends : {false, true}) {
        const Series s = waves(frames, 6, ++seed, 1.2), r = waves(rows, 6, ++seed);
        const std::string of = std::to_string(frames) + " on " + std::to_string(rows) +
                               " frames, smoothness " + std::to_string(smoothness);
        const auto result =
            iterative_motion_warp(s, r, {{most, free_ends}, smoothness, 2 * smoothness, 50, 0.0, true}, work);
        expect_never_rises(result.energy, r, of);
        EXPECT_TRUE(result.settled) << of;
      }
    }
  }
}

TEST(IterativeMotionWarp, SeesThroughScaleAndOffset) {
  Alone work;
  // The clock's series is the other one bent in time, twice as large and shifted: plain warping is misled by
  // that.
  const std::size_t frames = 300;
  const auto bent = [](double f) { return f + 12 * std::sin(f / 300 * 6.283185307); };
  Series s(frames, 2), r(frames, 2);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f), u = bent(t);
    s.dim(0)[f] = std::sin(0.1 * t);
    s.dim(1)[f] = std::cos(0.07 * t);
    r.dim(0)[f] = 2 * std::sin(0.1 * u) + 1.5;
    r.dim(1)[f] = 0.5 * std::cos(0.07 * u) - 2;
  }
  const auto error = [&](const WarpPath& path) {
    double sum = 0;
    for (std::size_t f = 0; f < frames; ++f) sum += std::abs(path[f] - bent(static_cast<double>(f)));
    return sum / frames;
  };
  MotionWarpSettings settings{{3, false}, 30, 30, 100, 1e-4, true};
  const double warped = error(iterative_motion_warp(s, r, settings, work).path);
  settings.scale_and_offset = false;
  const auto plain = iterative_motion_warp(s, r, settings, work);
  EXPECT_LT(warped, 1.0);
  EXPECT_GT(error(plain.path), 3 * warped);
  EXPECT_EQ(plain.rounds, 1);
  for (double value : plain.a.values) EXPECT_EQ(value, 1.0);
}

TEST(IterativeMotionWarp, EqualSeriesSettleAtOnceOnTheIdentity) {
  Alone work;
  const Series s = waves(60, 4, 7);
  const auto result = iterative_motion_warp(s, s, {{3, false}, 10, 10, 20, 1e-6, true}, work);
  EXPECT_EQ(result.rounds, 1);
  EXPECT_TRUE(result.settled);
  for (double energy : result.energy) EXPECT_EQ(energy, 0.0);
  for (std::uint32_t r = 0; r < 60; ++r) EXPECT_EQ(result.path[r], r);
}

}  // namespace
}  // namespace kinegraph
