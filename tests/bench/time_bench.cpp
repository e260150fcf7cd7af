// Time warping: the search, the space warp, and TimeWarp and UnwarpTime on motions as long as Wu's.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "nodes/time/dynamic_time_warp.h"
#include "nodes/time/iterative_motion_warp.h"
#include "nodes/time/space_warp.h"
#include "nodes/time/time_warp.h"
#include "nodes/time/unwarp_time.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

Series waves(std::size_t frames, std::size_t dims, unsigned seed) {
  std::mt19937 generator(seed);
  const auto unit = [&] { return generator() / 4294967296.0; };
  Series series(frames, dims);
  for (std::size_t d = 0; d < dims; ++d) {
    const double phase = 6 * unit(), rate = 0.05 + 0.01 * unit();
    for (std::size_t f = 0; f < frames; ++f)
      series.dim(d)[f] = std::sin(phase + rate * static_cast<double>(f)) + 0.2 * unit();
  }
  return series;
}

void search(benchmark::State& state) {
  const auto frames = static_cast<std::size_t>(state.range(0)),
             rows = static_cast<std::size_t>(state.range(1));
  const Series warped = waves(frames, 60, 1), clock = waves(rows, 60, 2);
  Alone work;
  for (auto _ : state) benchmark::DoNotOptimize(dynamic_time_warp(warped, clock, {3, false}, work));
}
BENCHMARK(search)
    ->Unit(benchmark::kMillisecond)
    ->Args({400, 427})
    ->Args({1000, 1200})
    ->Args({20'000, 20'000});

void space_warp(benchmark::State& state) {
  const Series s = waves(300, 60, 1), r = waves(360, 60, 2);
  Alone work;
  const WarpPath path = dynamic_time_warp(s, r, {3, false}, work);
  for (auto _ : state) {
    for (std::size_t d = 0; d < 60; ++d) {
      std::vector<double> a(300, 1.0), b(300, 0.0);
      benchmark::DoNotOptimize(solve_space_warp(s.dim(d), r.dim(d), path, {100, 100, 1e-9}, a, b));
    }
  }
}
BENCHMARK(space_warp)->Unit(benchmark::kMillisecond);

void warp_motions(benchmark::State& state) {
  const Motion source = bent(gait("walk", 4), 400, 0.5), reference = bent(gait("sneak", 4), 427, -0.5);
  Alone work;
  int rounds = 0;
  for (auto _ : state) rounds = time_warp(source, reference, {}, work).warp.rounds;
  state.counters["rounds"] = rounds;
}
BENCHMARK(warp_motions)->Unit(benchmark::kMillisecond);

void unwarp_motion(benchmark::State& state) {
  const Motion source = bent(gait("walk", 4), 400, 0.5), reference = bent(gait("sneak", 4), 427, -0.5);
  Alone work;
  const TimeWarpResult result = time_warp(source, reference, {}, work);
  for (auto _ : state) benchmark::DoNotOptimize(unwarp_time(*result.warped, result.warp, work));
}
BENCHMARK(unwarp_motion)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kinegraph
