// Exaggerate and RubberJoints on Gait's 23 joints and 58 sub-joints, one thread, a frame.
#include <benchmark/benchmark.h>

#include "nodes/cartoon/exaggerate.h"
#include "nodes/cartoon/rubber_joints.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

void per_frame(benchmark::State& state, const Motion& motion) {
  state.counters["ms_a_frame"] =
      benchmark::Counter(1e-3 * static_cast<double>(motion.frames()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void exaggerate_run(benchmark::State& state) {
  const Motion run = gait("run", 5, 120);
  Alone work;
  for (auto _ : state) benchmark::DoNotOptimize(exaggerate(run, {}, work));
  per_frame(state, run);
}
BENCHMARK(exaggerate_run)->Unit(benchmark::kMillisecond);

void rubber_run(benchmark::State& state) {
  Alone work;
  const Motion run = exaggerate(gait("run", 5, 120), {}, work).motion;
  for (auto _ : state) benchmark::DoNotOptimize(rubber_joints(run, {}, nullptr, work));
  per_frame(state, run);
}
BENCHMARK(rubber_run)->Unit(benchmark::kMillisecond);

void whole_chain(benchmark::State& state) {
  const Motion run = gait("run", 5, 120);
  Alone work;
  for (auto _ : state)
    benchmark::DoNotOptimize(rubber_joints(exaggerate(run, {}, work).motion, {}, nullptr, work));
  per_frame(state, run);
}
BENCHMARK(whole_chain)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kinegraph
