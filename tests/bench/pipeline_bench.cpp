// The main job, step by step and whole, on clips as long as Wu's (427 and 400 frames), one thread, loading
// left out; and the cleaning of feet by the frame.
#include <benchmark/benchmark.h>

#include "nodes/feet/detect_contacts.h"
#include "nodes/feet/footskate.h"
#include "nodes/style/quat_stats.h"
#include "nodes/style/style_transfer.h"
#include "nodes/time/time_warp.h"
#include "nodes/time/trim.h"
#include "nodes/time/unwarp_time.h"
#include "tests/nodes/feet/walks_and_runs.h"

namespace kinegraph {
namespace {

struct Clips {
  Motion source, reference;
};

// CMU 16_15, a walk, and 17_03, a stealthy one.
std::optional<Clips> clips(benchmark::State& state) {
  if (!std::filesystem::exists(mocap("README.md"))) {
    state.SkipWithError("no motion capture; set KINEGRAPH_MOCAP");
    return {};
  }
  const auto frames = [](std::int64_t count) { return Frames{0, static_cast<std::size_t>(count)}; };
  return Clips{trimmed(clip("cmu/asfamc/16_15.amc"), frames(state.range(0))),
               trimmed(clip("cmu/asfamc/17_03.amc"), frames(state.range(1)))};
}

const Motion& or_else(const std::optional<Motion>& motion, const Motion& otherwise) {
  return motion ? *motion : otherwise;
}

void whole_pipeline(benchmark::State& state) {
  const auto two = clips(state);
  if (!two) return;
  Alone work;
  for (auto _ : state) {
    const TimeWarpResult warp = time_warp(two->source, two->reference, {}, work);
    const Stats style = quat_stats(or_else(warp.reference, two->reference), {}, work);
    const StyleTransferResult styled =
        style_transfer(or_else(warp.warped, two->source), style, nullptr, {}, work);
    const Motion unwarped = unwarp_time(styled.motion, warp.warp, work);
    const Contacts plants = detect_contacts(two->source, {}, work);
    const std::vector<double> whole(unwarped.frames(), 1.0);
    benchmark::DoNotOptimize(clean_footskate(unwarped, plants, {}, whole, work));
  }
}
BENCHMARK(whole_pipeline)->Unit(benchmark::kMillisecond)->Args({427, 400})->Args({400, 427});

void time_warp_step(benchmark::State& state) {
  const auto two = clips(state);
  if (!two) return;
  Alone work;
  for (auto _ : state) benchmark::DoNotOptimize(time_warp(two->source, two->reference, {}, work));
}
BENCHMARK(time_warp_step)->Unit(benchmark::kMillisecond)->Args({427, 400})->Args({400, 427});

void quat_stats_step(benchmark::State& state) {
  const auto two = clips(state);
  if (!two) return;
  Alone work;
  for (auto _ : state) benchmark::DoNotOptimize(quat_stats(two->source, {}, work));
}
BENCHMARK(quat_stats_step)->Unit(benchmark::kMillisecond)->Args({427, 400});

void style_transfer_step(benchmark::State& state) {
  const auto two = clips(state);
  if (!two) return;
  Alone work;
  const Stats style = quat_stats(two->reference, {}, work);
  for (auto _ : state) benchmark::DoNotOptimize(style_transfer(two->source, style, nullptr, {}, work));
}
BENCHMARK(style_transfer_step)->Unit(benchmark::kMillisecond)->Args({427, 400});

void unwarp_time_step(benchmark::State& state) {
  const auto two = clips(state);
  if (!two) return;
  Alone work;
  const TimeWarpResult warp = time_warp(two->source, two->reference, {}, work);
  for (auto _ : state) benchmark::DoNotOptimize(unwarp_time(*warp.warped, warp.warp, work));
}
BENCHMARK(unwarp_time_step)->Unit(benchmark::kMillisecond)->Args({400, 427});

void detect_contacts_step(benchmark::State& state) {
  const auto two = clips(state);
  if (!two) return;
  Alone work;
  for (auto _ : state) benchmark::DoNotOptimize(detect_contacts(two->source, {}, work));
}
BENCHMARK(detect_contacts_step)->Unit(benchmark::kMillisecond)->Args({427, 400});

void footskate_step(benchmark::State& state) {
  const auto two = clips(state);
  if (!two) return;
  Alone work;
  const Motion skating = drifted(two->source, 0.1, 0.1);
  const Contacts plants = detect_contacts(skating, {}, work);
  const std::vector<double> whole(skating.frames(), 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(clean_footskate(skating, plants, {}, whole, work));
  state.counters["frame"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(skating.frames()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(footskate_step)->Unit(benchmark::kMillisecond)->Args({427, 400});

}  // namespace
}  // namespace kinegraph
