// A graph of 1,000 nodes formatted, validated, compared and merged, from text to text, as the commands do it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>

#include "graph/file/diff.h"
#include "graph/file/merge.h"
#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/validate.h"
#include "nodes/all_nodes.h"

namespace kinegraph {
namespace {

// 250 walks smoothed, measured and restyled in a chain. A side changes a third of its own nodes' values,
// renames a few and adds one.
std::string chain(const Registry& registry, int side) {
  std::string nodes, layout;
  for (int i = 0; i < 250; ++i) {
    const std::string stats = side == 1 && i < 5 ? fmt::format("style_{}", i) : fmt::format("stats_{}", i);
    const std::string before = i == 0 ? "smooth_0" : fmt::format("restyle_{}", i - 1);
    nodes += fmt::format(
        R"("walk_{0}": {{"type": "Gait", "params": {{"seconds": {1}, "seed": {0}}}}},
           "smooth_{0}": {{"type": "Filter", "params": {{"cutoff": {2}}}, "inputs": {{"motion": "walk_{0}.motion"}}}},
           "{3}": {{"type": "QuatStats", "inputs": {{"motion": "smooth_{0}.motion"}}}},
           "restyle_{0}": {{"type": "StyleTransfer", "params": {{"amount": 0.5}},
                          "inputs": {{"motion": "{4}.motion", "style": "{3}.stats"}}}},)",
        i, side == 1 && i % 3 == 0 ? 9 : 2, side == 2 && i % 3 == 1 ? 9 : 3, stats, before);
    for (const std::string& name :
         {fmt::format("walk_{}", i), fmt::format("smooth_{}", i), stats, fmt::format("restyle_{}", i)})
      layout += fmt::format(R"("{}": {{"pos": [{}, {}]}},)", name, i * 200, layout.size() % 700);
  }
  if (side > 0)
    nodes +=
        fmt::format(R"("trim_{0}": {{"type": "Trim", "inputs": {{"motion": "walk_{0}.motion"}}}},)", side);
  nodes.pop_back();
  layout.pop_back();
  return write_document(read_document(R"({"format": "kinegraph", "schema": 1, "nodes": {)" + nodes +
                                          R"(}, "ui": {"nodes": {)" + layout + "}}}",
                                      "g", registry)
                            .document,
                        registry);
}

void format_1000(benchmark::State& state) {
  const Registry registry = all_nodes();
  const std::string text = chain(registry, 0);
  for (auto _ : state)
    if (write_document(read_document(text, "g", registry).document, registry) != text)
      state.SkipWithError("not canonical");
}
BENCHMARK(format_1000)->Unit(benchmark::kMillisecond);

void validate_1000(benchmark::State& state) {
  const Registry registry = all_nodes();
  const std::string text = chain(registry, 0);
  for (auto _ : state)
    if (has_error(validate(read_document(text, "g", registry).document, registry, {.check_files = false})))
      state.SkipWithError("not valid");
}
BENCHMARK(validate_1000)->Unit(benchmark::kMillisecond);

void diff_1000(benchmark::State& state) {
  const Registry registry = all_nodes();
  const std::string base = chain(registry, 0), ours = chain(registry, 1);
  for (auto _ : state)
    if (diff(read_document(base, "g", registry).document, read_document(ours, "g", registry).document)
            .renames.size() != 5)
      state.SkipWithError("renames not found");
}
BENCHMARK(diff_1000)->Unit(benchmark::kMillisecond);

void merge_1000(benchmark::State& state) {
  const Registry registry = all_nodes();
  const std::string base = chain(registry, 0), ours = chain(registry, 1), theirs = chain(registry, 2);
  for (auto _ : state)
    if (!merge(read_document(base, "g", registry).document, read_document(ours, "g", registry).document,
               read_document(theirs, "g", registry).document, registry)
             .conflicts.empty())
      state.SkipWithError("a conflict");
}
BENCHMARK(merge_1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kinegraph
