// What one changed value of a ComponentEdit costs the editor: the evaluator runs the graph again, everything
// before the changed node comes from memory, and motion and components come out. Of every `op`, on clips of
// 1,000 frames.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>

#include "graph/evaluate/evaluator.h"
#include "graph/file/read.h"
#include "nodes/all_nodes.h"
#include "tests/mocap.h"

namespace kinegraph {
namespace {

// A Gait's walk and sneak, or boxing and a sneak.
std::string clips(bool real) {
  if (!real)
    return R"("a": {"type": "Gait", "params": {"seconds": 8.3333}},
      "b": {"type": "Gait", "params": {"gait": "sneak", "seconds": 4}},)";
  const auto load = [](const char* name, const char* clip, int end) {
    return fmt::format(R"("{}": {{"type": "Load", "params": {{"file": "{}", "range": [0, {}]}}}},)", name,
                       mocap(std::string("cmu/asfamc/") + clip + ".amc"), end);
  };
  return load("a", "17_10", 1000) + load("b", "17_03", 450);
}

// One value of the slider: it stands for {} in `edits`.
void edit_value(benchmark::State& state, const char* edits, bool real,
                const char* representation = "points") {
  if (real && !std::filesystem::exists(mocap("README.md"))) {
    state.SkipWithError("no motion capture");
    return;
  }
  const Registry registry = all_nodes();
  FileStore files;
  MemoryCache memory(std::size_t{1} << 30);
  Evaluator evaluator(registry, files, &memory, nullptr);
  const std::string folder = std::filesystem::temp_directory_path().string();
  double value = 0.3;
  const auto run = [&] {
    const std::string text = fmt::format(
        R"({{"format": "kinegraph", "schema": 1, "nodes": {{{}
        "ica": {{"type": "ICA", "params": {{"components": 5, "representation": "{}"}}, "inputs": {{"motions": ["a.motion", "b.motion"]}}}},
        "alone": {{"type": "ComponentMotion", "inputs": {{"components": "ica.components"}}}},
        "bent": {{"type": "Filter", "params": {{"method": "gaussian"}}, "inputs": {{"motion": "alone.motion"}}}},
        "it": {{"type": "ComponentEdit", "params": {{"edits": [{}]}},
          "inputs": {{"components": "ica.components", "other": "ica.components", "edited": "bent.motion"}}}}}}}})",
        clips(real), representation, fmt::format(fmt::runtime(edits), value += 0.001));
    const Document document = read_document(text, "bench", registry).document;
    Diagnostics problems;
    const Plan plan = make_plan(document, registry, {.folder = folder, .out = folder}, problems);
    const RunLog log =
        evaluator.run(plan, {{"it", "motion"}, {"it", "components"}}, {.threads = 1, .allow_outside = true});
    if (log.nodes.at("it").state != NodeState::done) state.SkipWithError("the edit failed");
  };
  run();  // all that comes before, and what is found once
  for (auto _ : state) run();
}

#define EDIT_VALUE(name, edits)                                     \
  BENCHMARK_CAPTURE(edit_value, name##_of_a_gait, edits, false)     \
      ->Unit(benchmark::kMillisecond)                               \
      ->UseRealTime()                                               \
      ->MeasureProcessCPUTime();                                    \
  BENCHMARK_CAPTURE(edit_value, name##_of_a_real_clip, edits, true) \
      ->Unit(benchmark::kMillisecond)                               \
      ->UseRealTime()                                               \
      ->MeasureProcessCPUTime()

EDIT_VALUE(scale, R"({{"op": "scale", "component": 1, "factor": {}}})");
EDIT_VALUE(merge, R"({{"op": "merge", "name": "g", "terms": [[1, {0}], [2, 1]]}})");
EDIT_VALUE(
    merge_and_scale,
    R"({{"op": "merge", "name": "g", "terms": [[1, 1], [2, 1]]}}, {{"op": "scale", "component": "g", "factor": {}}})");
EDIT_VALUE(translate, R"({{"op": "translate", "component": 1, "value": {}}})");
EDIT_VALUE(
    replace,
    R"({{"op": "replace", "component": 1, "frames": [100, 300], "by_frames": [400, 500], "fade": {}}})");
EDIT_VALUE(copy_add, R"({{"op": "copy_add", "component": 1, "segment": 1, "factor": {}}})");
EDIT_VALUE(transfer, R"({{"op": "transfer", "components": 1, "from": 1, "to": 0, "amount": {}}})");
EDIT_VALUE(
    transfer_in_the_givers_timing,
    R"({{"op": "transfer", "components": 1, "from": 1, "to": 0, "keep_timing_of": "from", "amount": {}}})");
EDIT_VALUE(
    transfer_of_a_group,
    R"({{"op": "merge", "name": "g", "terms": [[1, 1], [2, 1]]}}, {{"op": "transfer", "components": "g", "from": 1, "to": 0, "align": ["group:g"], "amount": {}}})");
EDIT_VALUE(substitute,
           R"({{"op": "scale", "component": 2, "factor": {}}}, {{"op": "substitute", "component": 1}})");
EDIT_VALUE(warp, R"({{"op": "warp", "component": 1, "keys": [[100, {}]]}})");

// The component that is substituted, changed before: it is shown as a motion anew for every value.
EDIT_VALUE(scale_and_substitute,
           R"({{"op": "scale", "component": 1, "factor": {}}}, {{"op": "substitute", "component": 1}})");
EDIT_VALUE(
    transfer_and_substitute,
    R"({{"op": "transfer", "components": [1, 2, 3, 4, 5], "from": 1, "to": 0, "amount": {}}}, {{"op": "substitute", "component": 1}})");
#define EDIT_VALUE_IN(representation)                                                                     \
  BENCHMARK_CAPTURE(                                                                                      \
      edit_value, scale_and_substitute_in_##representation,                                               \
      R"({{"op": "scale", "component": 1, "factor": {}}}, {{"op": "substitute", "component": 1}})", true, \
      #representation)                                                                                    \
      ->Unit(benchmark::kMillisecond)                                                                     \
      ->UseRealTime()                                                                                     \
      ->MeasureProcessCPUTime()
EDIT_VALUE_IN(quaternions);
EDIT_VALUE_IN(euler);
EDIT_VALUE_IN(logarithm);

}  // namespace
}  // namespace kinegraph
