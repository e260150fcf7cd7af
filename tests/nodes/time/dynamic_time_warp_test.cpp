#include "nodes/time/dynamic_time_warp.h"

#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <cmath>
#include <limits>
#include <random>

#include "nodes/time/dynamic_time_warp_kernels.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

Series random_series(std::size_t frames, std::size_t dims, unsigned seed, double wave = 0) {
  std::mt19937 generator(seed);
  Series series(frames, dims);
  for (std::size_t d = 0; d < dims; ++d)
    for (std::size_t f = 0; f < frames; ++f)
      series.dim(d)[f] =
          generator() / 4294967296.0 + wave * std::sin(0.1 * static_cast<double>(f) + static_cast<double>(d));
  return series;
}

// The least cost by the definition: every state (row, frame, run) spelled out, no bands, no vectors.
double least_cost(const Series& warped, const Series& clock, const WarpLimits& limits) {
  const std::size_t frames = warped.frames, rows = clock.frames, k = limits.max_step;
  const double infinity = std::numeric_limits<double>::infinity();
  const auto cost = [&](std::size_t row, std::size_t frame) {
    double sum = 0;
    for (std::size_t d = 0; d < clock.dims; ++d) sum += std::pow(warped.at(d, frame) - clock.at(d, row), 2);
    return sum;
  };
  std::vector<std::vector<double>> before(frames, std::vector<double>(k + 1, infinity));
  for (std::size_t f = 0; f < frames; ++f)
    if (f == 0 || (limits.free_ends && f <= k)) before[f][1] = cost(0, f);
  for (std::size_t r = 1; r < rows; ++r) {
    std::vector<std::vector<double>> now(frames, std::vector<double>(k + 1, infinity));
    for (std::size_t f = 0; f < frames; ++f) {
      for (std::size_t run = 2; run <= k; ++run) now[f][run] = before[f][run - 1] + cost(r, f);
      for (std::size_t step = 1; step <= std::min(k, f); ++step)
        for (std::size_t run = 1; run <= k; ++run)
          now[f][1] = std::min(now[f][1], before[f - step][run] + cost(r, f));
    }
    before = now;
  }
  double least = infinity;
  for (std::size_t f = 0; f < frames; ++f)
    if (f + 1 == frames || (limits.free_ends && f + 1 + k >= frames))
      for (double c : before[f]) least = std::min(least, c);
  return least;
}

void expect_within_limits(const WarpPath& path, std::size_t frames, const WarpLimits& limits) {
  if (limits.free_ends) {
    EXPECT_LE(path.front(), limits.max_step);
    EXPECT_GE(path.back() + limits.max_step + 1, frames);
  } else {
    EXPECT_EQ(path.front(), 0u);
    EXPECT_EQ(path.back(), frames - 1);
  }
  std::size_t run = 1;
  for (std::size_t r = 1; r < path.size(); ++r) {
    ASSERT_GE(path[r], path[r - 1]);
    ASSERT_LE(path[r] - path[r - 1], limits.max_step);
    run = path[r] == path[r - 1] ? run + 1 : 1;
    ASSERT_LE(run, limits.max_step);
  }
}

TEST(DynamicTimeWarp, FindsTheLeastCostWithinItsLimits) {
  Alone work;
  unsigned seed = 0;
  for (const auto& [frames, rows] :
       {std::pair<std::size_t, std::size_t>{7, 7}, {5, 12}, {19, 23}, {33, 40}, {2, 9}}) {
    for (std::size_t max_step : {2, 3, 4, 5, 11, 20}) {
      for (bool free_ends : {false, true}) {
        const WarpLimits limits{max_step, free_ends};
        if (max_step < least_max_step(frames, rows)) continue;
        const Series warped = random_series(frames, 3, ++seed), clock = random_series(rows, 3, ++seed);
        const WarpPath path = dynamic_time_warp(warped, clock, limits, work);
        ASSERT_EQ(path.size(), rows);
        expect_within_limits(path, frames, limits);
        EXPECT_NEAR(path_cost(warped, clock, path), least_cost(warped, clock, limits), 1e-12)
            << frames << " on " << rows << ", max_step " << max_step << ", free " << free_ends;
      }
    }
  }
}

TEST(DynamicTimeWarp, LaysEqualSeriesOnEachOtherFrameForFrame) {
  Alone work;
  const Series series = random_series(50, 4, 3);
  const WarpPath path = dynamic_time_warp(series, series, {3, false}, work);
  for (std::uint32_t r = 0; r < path.size(); ++r) EXPECT_EQ(path[r], r);
}

TEST(DynamicTimeWarp, AdvancesByOneWhereEveryPathIsAsGood) {
  Alone work;
  const Series flat(10, 2);
  const WarpPath path = dynamic_time_warp(flat, flat, {3, false}, work);
  for (std::uint32_t r = 0; r < path.size(); ++r) EXPECT_EQ(path[r], r);
  // Traced from the end: it advances by 1 as long as it can, and then stays rather than leaves frames out.
  const WarpPath longer = dynamic_time_warp(Series(4, 1), Series(6, 1), {3, false}, work);
  EXPECT_EQ(longer, (WarpPath{0, 0, 0, 1, 2, 3}));
}

TEST(DynamicTimeWarp, FindsTimeThatWasBent) {
  Alone work;
  // Two turns of a helix, whose time runs at 0.6 to 1.6 times the clock's.
  const auto helix = [](std::size_t frames, auto time) {
    Series series(frames, 3);
    for (std::size_t f = 0; f < frames; ++f) {
      const double t = time(static_cast<double>(f) / static_cast<double>(frames - 1));
      series.dim(0)[f] = std::cos(12 * t);
      series.dim(1)[f] = std::sin(12 * t);
      series.dim(2)[f] = t;
    }
    return series;
  };
  const auto bent = [](double t) { return t + 0.09 * std::sin(6.283185307 * t); };
  const WarpPath path =
      dynamic_time_warp(helix(200, [](double t) { return t; }), helix(260, bent), {3, false}, work);
  for (std::size_t r = 0; r < 260; ++r)
    EXPECT_NEAR(path[r], 199 * bent(static_cast<double>(r) / 259), 0.75) << "row " << r;
}

TEST(DynamicTimeWarp, ABandWidensWhereThePathTouchesIt) {
  Alone work;
  const Series warped = random_series(300, 2, 1, 3.0), clock = random_series(330, 2, 2, 3.0);
  const WarpPath best = dynamic_time_warp(warped, clock, {3, false}, work);
  WarpPath straight(330);
  for (std::uint32_t r = 0; r < 330; ++r) straight[r] = r * 299 / 329;
  std::uint32_t farthest = 0;
  for (std::size_t r = 0; r < 330; ++r)
    farthest = std::max(farthest, best[r] > straight[r] ? best[r] - straight[r] : straight[r] - best[r]);
  ASSERT_GT(farthest, 4u) << "the test means to start from too narrow a band";
  const WarpBand narrow{straight, 2};
  EXPECT_EQ(dynamic_time_warp(warped, clock, {3, false}, work, &narrow), best);
  const WarpBand wide{straight, farthest + 2};
  EXPECT_EQ(dynamic_time_warp(warped, clock, {3, false}, work, &wide), best);
}

TEST(DynamicTimeWarp, OneFrameFillsEveryRow) {
  Alone work;
  EXPECT_EQ(dynamic_time_warp(Series(1, 2), Series(4, 2), {4, false}, work), (WarpPath{0, 0, 0, 0}));
  EXPECT_EQ(dynamic_time_warp(Series(1, 2), Series(1, 2), {3, true}, work), (WarpPath{0}));
}

TEST(DynamicTimeWarp, NamesTheLeastMaxStepThatFits) {
  Alone work;
  try {
    dynamic_time_warp(Series(10, 1), Series(41, 1), {4, false}, work);
    FAIL() << "41 rows can't be filled by 10 frames held for 4";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "does-not-fit");
    EXPECT_EQ(failure.diagnostic().param, "max_step");
    EXPECT_THAT(failure.diagnostic().hint, HasSubstr("5"));
  }
  EXPECT_EQ(dynamic_time_warp(Series(10, 1), Series(41, 1), {5, false}, work).size(), 41u);
  EXPECT_EQ(default_max_step(10, 41), 6u);
  EXPECT_EQ(default_max_step(400, 427), 3u);
}

TEST(DynamicTimeWarp, GivesTheSameBitsOnEveryInstructionSet) {
  Alone work;
  const Series warped = random_series(117, 13, 5, 1.0), clock = random_series(140, 13, 6, 1.0);
  std::vector<double> tiles(8 * 13 * warp_tile), first;
  for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i] = std::sin(static_cast<double>(i));
  std::vector<WarpPath> first_paths;
  for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    std::vector<double> distances(5 * 128);
    squared_distances(tiles.data(), 0, 8, 13, clock.values.data(), 5, distances.data(), 128);
    std::vector<WarpPath> paths;
    for (std::size_t max_step : {2, 3, 7, 30})
      paths.push_back(dynamic_time_warp(warped, clock, {max_step, true}, work));
    if (first.empty()) {
      first = distances;
      first_paths = paths;
    }
    EXPECT_EQ(distances, first) << hwy::TargetName(target);
    EXPECT_EQ(paths, first_paths) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(DynamicTimeWarp, AsksForItsMemoryAndStopsWhenTold) {
  class Stopped : public Alone {
   public:
    void check() override {
      if (++checks == 3) throw Cancelled();
    }
    std::shared_ptr<void> reserve(std::size_t bytes) override {
      reserved += bytes;
      return {};
    }
    int checks = 0;
    std::size_t reserved = 0;
  } work;
  const Series series(10'000, 1);
  EXPECT_THROW(dynamic_time_warp(series, series, {3, false}, work), Cancelled);
  EXPECT_GT(work.reserved, std::size_t{20} << 20);
  EXPECT_LT(work.reserved, std::size_t{50} << 20) << "four bits a cell that the limits leave open";
}

TEST(Align, PairsFramesOnTheLongerClock) {
  Alone work;
  const Series a = random_series(12, 2, 1, 2.0), b = random_series(20, 2, 2, 2.0);
  const Correspondence there = align(a, b, 0, false, work), back = align(b, a, 0, false, work);
  EXPECT_FALSE(there.a_is_clock);
  EXPECT_TRUE(back.a_is_clock);
  ASSERT_EQ(there.pairs.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(there.pairs[i].second, i);
    EXPECT_EQ(there.pairs[i].first, back.pairs[i].second);
  }
}

}  // namespace
}  // namespace kinegraph
