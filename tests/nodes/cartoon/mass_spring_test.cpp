#include "nodes/cartoon/mass_spring.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/cartoon/rubber_joints.h"
#include "nodes/motion/elementary.h"
#include "tests/nodes/every_target.h"

namespace kinegraph {
namespace {

// Ten particles in a row, 10 cm apart; the chain sways about z like an arm for `moving` seconds and then
// rests.
const std::vector<int> row{-1, 0, 1, 2, 3, 4, 5, 6, 7, 8};

ParticlePath arm(double fps, double seconds, double moving, double hertz = 1, Vec3 travel = {}) {
  ParticlePath path{row.size(), {}};
  const auto frames = static_cast<std::size_t>(seconds * fps) + 1;
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = std::min(static_cast<double>(f) / fps, moving);
    const double angle = 0.8 * std::sin(2 * pi * hertz * t);
    for (std::size_t i = 0; i < row.size(); ++i)
      path.at.push_back(0.1 * static_cast<double>(i) * Vec3{std::sin(angle), -std::cos(angle), 0} +
                        t * travel);
  }
  return path;
}

double largest(const ParticlePath& path) {
  double size = 0;
  for (Vec3 v : path.at) {
    const double n = norm(v);
    if (!std::isfinite(n)) return n;
    size = std::max(size, n);
  }
  return size;
}

double farthest(const ParticlePath& a, const ParticlePath& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.at.size(); ++i) worst = std::max(worst, norm(a.at[i] - b.at[i]));
  return worst;
}

TEST(MassSpring, StaysFiniteForEveryStiffnessAndDragAtEveryRate) {
  Alone work;
  for (double fps : {24.0, 240.0})
    for (double hook : {0.0, 300.0, 1e6})
      for (double link : {0.0, 600.0, 1e6})
        for (double drag : {0.0, 12.0, 1e4})
          for (int substeps : {0, 1}) {
            const auto result =
                simulate(row, arm(fps, 1, 0.7, 3), fps, {hook, link, drag, true, substeps}, false, work);
            EXPECT_LT(largest(result.positions), 100) << fps << " " << hook << " " << link << " " << drag;
          }
}

TEST(MassSpring, NeverGainsEnergyFromRest) {
  Alone work;
  for (double fps : {24.0, 120.0})
    for (double hook : {20.0, 300.0, 1e6})
      for (double link : {0.0, 600.0, 1e5})
        for (double drag : {0.0, 12.0}) {
          const MassSpringParams params{hook, link, drag, true, 0};
          const ParticlePath driven = arm(fps, 3, 1.1, 2);
          const auto result = simulate(row, driven, fps, params, true, work);
          const std::size_t n = row.size();
          // From the second frame after it has come to rest: until then the cubic between frames still moves.
          const auto first = static_cast<std::size_t>(1.1 * fps) + 3;
          double before = 0, start = 0;
          for (std::size_t f = first; f < driven.frames(); ++f) {
            const auto of = [&](const ParticlePath& path) { return std::span(path.at).subspan(f * n, n); };
            const double energy =
                energy_of(row, of(driven), of(result.positions), of(result.velocities), params);
            if (f == first) start = energy;
            if (f > first) {
              EXPECT_LE(energy, before + 1e-9 * before + 1e-22 * (hook + link))
                  << fps << " " << hook << " " << link << " " << drag << " frame " << f;
            }
            before = energy;
          }
          EXPECT_LT(before, drag > 0 ? 0.5 * start : (1 + 1e-8) * start);
          EXPECT_GT(before, drag > 0 ? 0 : (1 - 1e-8) * start);
        }
}

TEST(MassSpring, LeavesAStillChainWhereItIs) {
  Alone work;
  const auto whole = arm(60, 1, 0.2);
  ParticlePath still{row.size(), {}};
  for (int f = 0; f < 60; ++f)
    still.at.insert(still.at.end(), whole.at.end() - static_cast<std::ptrdiff_t>(row.size()), whole.at.end());
  EXPECT_EQ(farthest(simulate(row, still, 60, {}, false, work).positions, still), 0);
}

TEST(MassSpring, TravelsSteadilyWithTheRootAndTrailsInTheWorld) {
  Alone work;
  const Vec3 travel{1.5, 0, 0};
  const auto glide = arm(60, 4, 1e9, 0, travel);
  MassSpringParams params;
  EXPECT_LT(farthest(simulate(row, glide, 60, params, false, work).positions, glide), 1e-9);
  params.drag_in_root = false;
  const auto trailing = simulate(row, glide, 60, params, false, work).positions;
  const Vec3 lag = glide.at.back() - trailing.at.back();
  EXPECT_NEAR(lag.x, params.drag * travel.x / params.hook, 1e-3);  // drag v / hook
}

TEST(MassSpring, ConvergesWithTheStep) {
  Alone work;
  const auto at = [&](int substeps) {
    MassSpringParams params;
    params.substeps = substeps;
    return simulate(row, arm(60, 3, 2, 1.3), 60, params, false, work).positions;
  };
  const auto once = at(4), twice = at(8), four = at(16);
  const double first = farthest(once, twice), second = farthest(twice, four);
  EXPECT_LT(first, 0.01 * 1.7);
  EXPECT_LE(second, 0.3 * first) << "second order: a quarter";
}

// Seconds by which the tip follows a swing of one hertz, by the phases of both in the later half. `blend`: 1
// is that of the masses, RubberJoints' own default that of what comes out of it.
double lag(double fps, double blend) {
  Alone work;
  const auto driven = arm(fps, 6, 1e9, 1);
  ParticlePath masses = simulate(row, driven, fps, {}, false, work).positions;
  for (std::size_t i = 0; i < masses.at.size(); ++i)
    masses.at[i] = (1 - blend) * driven.at[i] + blend * masses.at[i];
  const auto phase = [&](const ParticlePath& path) {
    double s = 0, c = 0;
    for (std::size_t f = path.frames() / 2; f + 1 < path.frames(); ++f) {
      const double t = static_cast<double>(f) / fps;
      const double x = path.at[f * row.size() + row.size() - 1].x;
      s += x * std::sin(2 * pi * t);
      c += x * std::cos(2 * pi * t);
    }
    return std::atan2(s, c);
  };
  return (phase(masses) - phase(driven)) / (2 * pi);
}

TEST(MassSpring, FollowsThroughAlikeAtEveryRate) {
  for (double blend : {1.0, RubberParams{}.blend}) {
    const double slow = lag(24, blend), fast = lag(240, blend);
    EXPECT_GT(fast, 0.015);
    EXPECT_LT(fast, 0.080);
    EXPECT_NEAR(slow, fast, 0.05 * fast);
    const std::string of = " of blend " + std::to_string(blend);
    RecordProperty("lag_ms_at_24" + of, std::to_string(1000 * slow));
    RecordProperty("lag_ms_at_240" + of, std::to_string(1000 * fast));
  }
}

// A body of several limbs in any order, of which one branches.
TEST(MassSpring, GivesTheSameBitsOnEveryCpu) {
  const std::vector<int> body{-1, 0, 1, 0, 3, 4, 2, 2, 7, 8, 5, 6, -1, 12};
  ParticlePath driven{body.size(), {}};
  for (int f = 0; f < 40; ++f)
    for (std::size_t i = 0; i < body.size(); ++i) {
      const double part = static_cast<double>(i), t = f / 40.0;
      driven.at.push_back({0.1 * part, std::sin(part + 3 * t), std::cos(2 * part - 5 * t)});
    }
  on_every_target([&] {
    Alone work;
    std::vector<double> all;
    for (Vec3 v : simulate(body, driven, 60, {}, false, work).positions.at)
      all.insert(all.end(), {v.x, v.y, v.z});
    return all;
  });
}

}  // namespace
}  // namespace kinegraph
