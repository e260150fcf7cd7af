// Components: principal components, whitening, one start of FastICA and the default ones, and an edit's
// slider.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "nodes/components/component_edit.h"
#include "nodes/components/ica.h"
#include "nodes/components/principal.h"
#include "nodes/components/rebuild.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/resample.h"
#include "nodes/time/trim.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

std::shared_ptr<const Motion> real_motion(const std::string& name) {
  PlainFiles files;
  Alone work;
  const MotionFile file = read_motion_file(mocap("cmu/asfamc/" + name + ".amc"), {}, files, work);
  return std::make_shared<const Motion>(*file.motion());
}

// Laplace sources, mixed into 93 channels, with noise of 0.01: a set of 31 joints.
Rows mixed(std::size_t sources, std::size_t frames) {
  std::mt19937 generator(1);
  const auto unit = [&] { return (generator() + 0.5) / 4294967296.0; };
  Rows s(sources, frames), a(93, sources);
  for (double& x : s.data) {
    const double u = unit() - 0.5;
    x = -std::copysign(std::log(1 - 2 * std::fabs(u)), u);
  }
  for (double& x : a.data) x = 2 * unit() - 1;
  Rows x = product(a, s);
  for (double& value : x.data) value += 0.02 * (unit() - 0.5);
  return x;
}

void decompose_channels(benchmark::State& state) {
  const Rows x = mixed(12, static_cast<std::size_t>(state.range(0)));
  IcaParams params;
  params.components = 12;
  params.starts = static_cast<int>(state.range(1));
  Alone work;
  for (auto _ : state) benchmark::DoNotOptimize(decompose(x, params, work));
}
BENCHMARK(decompose_channels)
    ->Unit(benchmark::kMillisecond)
    ->Args({1000, 1})
    ->Args({10000, 1})
    ->Args({10000, 8});

// The default starts on two real clips, joined.
void decompose_real_clips(benchmark::State& state, const char* first, const char* second) {
  if (!std::filesystem::exists(mocap("README.md"))) {
    state.SkipWithError("no motion capture");
    return;
  }
  Alone work;
  const auto one = real_motion(first), other = real_motion(second);
  const std::vector<bool> all(static_cast<std::size_t>(one->joints()), true);
  const ChannelSpace space = space_of_motions(Representation::points, {one, other}, all, true, {}, work);
  IcaParams params;
  params.components = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(components_of_motions(space, {one, other}, params, work));
}
#define REAL_PAIR(a, b)                                         \
  BENCHMARK_CAPTURE(decompose_real_clips, a##_with_##b, #a, #b) \
      ->Unit(benchmark::kMillisecond)                           \
      ->Arg(3)                                                  \
      ->Arg(5)                                                  \
      ->Arg(12)
REAL_PAIR(16_31, 17_03);
REAL_PAIR(07_05, 17_03);
REAL_PAIR(16_45, 17_03);
REAL_PAIR(16_45, 16_31);

// One clip of 2,783 frames.
void decompose_boxing(benchmark::State& state) {
  if (!std::filesystem::exists(mocap("README.md"))) {
    state.SkipWithError("no motion capture");
    return;
  }
  Alone work;
  const auto clip = real_motion("17_10");
  const std::vector<bool> all(static_cast<std::size_t>(clip->joints()), true);
  const ChannelSpace space = space_of_motions(Representation::points, {clip}, all, true, {}, work);
  const Rows x = channels_of(space, *clip, {}, work);
  IcaParams params;
  params.components = 12;
  for (auto _ : state) benchmark::DoNotOptimize(decompose(x, params, work));
}
BENCHMARK(decompose_boxing)->Unit(benchmark::kMillisecond);

// Twelve CMU clips joined, at 120 frames a second and brought to 200: 6,834 and 11,379 frames.
void decompose_long_clips(benchmark::State& state, int starts) {
  if (!std::filesystem::exists(mocap("README.md"))) {
    state.SkipWithError("no motion capture");
    return;
  }
  Alone work;
  std::vector<std::shared_ptr<const Motion>> clips;
  for (const char* name : {"02_01", "02_04", "05_03", "07_05", "09_06", "16_05", "16_15", "16_31", "16_45",
                           "17_03", "17_10", "35_01"})
    clips.push_back(std::make_shared<const Motion>(
        resampled(*real_motion(name), static_cast<double>(state.range(0)), work)));
  const std::vector<bool> all(static_cast<std::size_t>(clips[0]->joints()), true);
  const ChannelSpace space = space_of_motions(Representation::points, clips, all, true, {}, work);
  std::vector<Rows> parts;
  std::size_t frames = 0;
  for (const auto& clip : clips) {
    parts.push_back(channels_of(space, *clip, {}, work));
    frames += clip->frames();
  }
  Rows x(parts.front().rows, frames);
  std::size_t at = 0;
  for (const Rows& part : parts) {
    for (std::size_t i = 0; i < x.rows; ++i) std::copy_n(part.row(i), part.columns, x.row(i) + at);
    at += part.columns;
  }
  IcaParams params;
  params.components = 12;
  params.starts = starts;
  for (auto _ : state) benchmark::DoNotOptimize(decompose(x, params, work));
}
BENCHMARK_CAPTURE(decompose_long_clips, one_start, 1)->Unit(benchmark::kMillisecond)->Arg(120)->Arg(200);
BENCHMARK_CAPTURE(decompose_long_clips, default_starts, 8)->Unit(benchmark::kMillisecond)->Arg(120)->Arg(200);

void principal_and_whitening(benchmark::State& state) {
  const Rows x = mixed(12, 10000);
  Alone work;
  for (auto _ : state) benchmark::DoNotOptimize(whiten(x, principal_components(x, work), 12, work));
}
BENCHMARK(principal_and_whitening)->Unit(benchmark::kMillisecond);

// A clip of 1,000 frames: one value of ComponentEdit's slider, with the motion that comes out.
void slide(benchmark::State& state, const std::vector<std::shared_ptr<const Motion>>& clips) {
  Alone work;
  const std::vector<bool> all(static_cast<std::size_t>(clips[0]->joints()), true);
  IcaParams params;
  params.components = 5;
  const Components components = components_of_motions(
      space_of_motions(Representation::points, clips, all, true, {}, work), clips, params, work);
  ComponentEditParams edit;
  double factor = 1;
  for (auto _ : state) {
    edit.edits = {edits::Scale{{1, ""}, factor += 0.01}};
    const ComponentEditResult result = edit_components(components, edit, {}, work);
    benchmark::DoNotOptimize(
        motion_of(result.components, result.channels, result.components.segments[result.segment], {}, work));
  }
}

void edit_slider(benchmark::State& state) {
  slide(state, {std::make_shared<const Motion>(gait("walk", 1000 / 120.0, 120)),
                std::make_shared<const Motion>(gait("sneak", 4, 120))});
}
BENCHMARK(edit_slider)->Unit(benchmark::kMillisecond);

// The same on boxing, 30 joints of which five have several links.
void edit_slider_on_real_clip(benchmark::State& state) {
  if (!std::filesystem::exists(mocap("README.md"))) {
    state.SkipWithError("no motion capture");
    return;
  }
  slide(state, {std::make_shared<const Motion>(trimmed(*real_motion("17_10"), {0, 1000}))});
}
BENCHMARK(edit_slider_on_real_clip)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kinegraph
