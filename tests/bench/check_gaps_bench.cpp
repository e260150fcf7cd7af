// How long nodes work on clips of 20,000 frames without asking whether to stop: the largest CPU time of a
// thread between two checks, and from a check that says stop to the end of the node, its memory freed.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <functional>

#include "nodes/feet/detect_contacts.h"
#include "nodes/feet/footskate.h"
#include "nodes/files/motion_file.h"
#include "nodes/style/quat_stats.h"
#include "nodes/style/style_transfer.h"
#include "nodes/time/time_warp.h"
#include "nodes/time/unwarp_time.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// One thread; stops at the check of a given number.
class Watched : public Alone {
 public:
  explicit Watched(int stop_at = -1) : stop_at_(stop_at), last_(cpu_ms()) {}
  void check() override {
    const double now = cpu_ms();
    largest_ = std::max(largest_, now - last_);
    last_ = now;
    if (checks_++ == stop_at_) throw Cancelled();
  }
  void progress(double) override { check(); }
  // In pieces of the least size, as a pool of many threads would cut it.
  void parallel(std::size_t count, std::size_t grain,
                const std::function<void(std::size_t, std::size_t)>& body) override {
    for (std::size_t begin = 0; begin < count; begin += std::max<std::size_t>(grain, 1)) {
      check();
      body(begin, std::min(count, begin + std::max<std::size_t>(grain, 1)));
    }
    check();
  }
  void over() { largest_ = std::max(largest_, cpu_ms() - last_); }
  double largest() const { return largest_; }
  double since_last() const { return cpu_ms() - last_; }
  int checks() const { return checks_; }

 private:
  int stop_at_, checks_ = 0;
  double last_, largest_ = 0;
};

void watch(benchmark::State& state, const std::function<void(Work&)>& node) {
  double gap = 0, leaving = 0;
  int checks = 0;
  for (auto _ : state) {
    Watched whole;
    node(whole);
    whole.over();
    gap = std::max(gap, whole.largest());
    checks = whole.checks();
    // Stopped at a few places.
    for (int stop = 0; stop < checks; stop += std::max(1, checks / 5)) {
      Watched cut(stop);
      try {
        node(cut);
      } catch (const Cancelled&) {
        leaving = std::max(leaving, cut.since_last());
      }
    }
  }
  state.counters["gap_ms"] = gap;
  state.counters["leaving_ms"] = leaving;
  state.counters["checks"] = checks;
}

constexpr std::size_t frames = 20'000;

Motion long_gait(const char* name, double bend) {
  return bent(gait(name, 160, 120), frames, bend);
}

void time_warp_gaps(benchmark::State& state) {
  const Motion walk = long_gait("walk", 0.5), sneak = long_gait("sneak", -0.5);
  watch(state, [&](Work& work) { benchmark::DoNotOptimize(time_warp(walk, sneak, {}, work)); });
}
BENCHMARK(time_warp_gaps)->Iterations(1)->Unit(benchmark::kMillisecond);

// The rest of the main job, on the same clip, one node after the other.
void other_gaps(benchmark::State& state) {
  const Motion walk = long_gait("walk", 0.5);
  Alone alone;
  const Stats style = quat_stats(long_gait("sneak", 0.3), {}, alone);
  const TimeWarpResult warped =
      time_warp(walk, bent(walk, frames + 9, 0.1), {.scale_and_offset = false}, alone);
  const Contacts contacts = detect_contacts(walk, {}, alone);
  const std::vector<std::function<void(Work&)>> nodes = {
      [&](Work& work) { quat_stats(walk, {}, work); },
      [&](Work& work) {
        StyleTransferParams params;
        params.weights.assign(walk.frames(), 1.0);
        params.joints.assign(static_cast<std::size_t>(walk.joints()), true);
        style_transfer(walk, style, nullptr, params, work);
      },
      [&](Work& work) { unwarp_time(*warped.warped, warped.warp, work); },
      [&](Work& work) { detect_contacts(walk, {}, work); },
      [&](Work& work) { clean_footskate(walk, contacts, {}, std::vector<double>(frames, 1.0), work); },
      [&](Work& work) {
        encode_motion_file("walk.bvh", "auto", {{"motion", std::make_shared<Motion>(walk)}}, {}, work);
      },
  };
  watch(state, nodes[static_cast<std::size_t>(state.range(0))]);
}
BENCHMARK(other_gaps)->DenseRange(0, 5)->ArgName("node")->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kinegraph
