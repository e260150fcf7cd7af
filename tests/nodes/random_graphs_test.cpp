// What is saved is what is loaded, for every graph that the grammar of random_graph.h can draw and every
// graph of the repository; and what is edited can be undone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "graph/file/diff.h"
#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/validate.h"
#include "nodes/all_nodes.h"
#include "tests/nodes/random_graph.h"

namespace kinegraph {
namespace {

const Registry& registry() {
  static const Registry all = all_nodes();
  return all;
}

std::string all_text(const Diagnostics& problems) {
  std::string text;
  for (const Diagnostic& problem : problems) text += to_text(problem) + "\n";
  return text;
}

TEST(RandomGraphs, TenThousandLoadAndSaveAsTheyAre) {
  RandomGraphs graphs(registry(), 20261122);
  for (int i = 0; i < 10000; ++i) {
    const Document drawn = graphs.next();
    const std::string saved = write_document(drawn, registry());
    const ReadResult read = read_document(saved, "g.kg.json", registry());
    ASSERT_FALSE(has_error(read.problems)) << "graph " << i << "\n" << all_text(read.problems) << saved;
    ASSERT_EQ(write_document(read.document, registry()), saved) << "graph " << i;
    // Nothing was lost on the way: no unit differs from what was drawn.
    const Diff lost = diff(drawn, read.document);
    ASSERT_TRUE(lost.empty() && !lost.layout) << "graph " << i << ": " << compact(to_json(lost)) << "\n"
                                              << saved;
  }
  for (const std::string& name : registry().names()) {
    const auto drawn = graphs.drawn().find(name);
    ASSERT_NE(drawn, graphs.drawn().end()) << name;
    EXPECT_GE(drawn->second, 20) << name;
    for (const Param& param : registry().find(name)->params) {
      const auto set = graphs.params().find(name + "." + param.name);
      EXPECT_TRUE(set != graphs.params().end() && set->second >= 20) << name << "." << param.name;
    }
  }
}

TEST(RandomGraphs, AreValidButForWhatWasLeftOpen) {
  RandomGraphs graphs(registry(), 7);
  const std::set<std::string> expected = {
      "open-input",    "unknown-type",       "newer-version",  "same-file",          "type-mismatch",
      "wrong-type",    "index-out-of-range", "no-file",        "absolute-path",      "bad-choice",
      "bad-range",     "not-an-integer",     "out-of-range",   "undefined-variable", "variable-not-replaced",
      "bad-variable",  "missing-key",        "unknown-key",    "one-link",           "several-inputs",
      "wrong-content", "nothing-to-write",   "unknown-format", "bad-pattern"};
  int whole = 0;
  for (int i = 0; i < 1000; ++i) {
    const Diagnostics problems = validate(
        graphs.next(), registry(), {.file = "g", .folder = "/", .check_files = false, .allow_outside = true});
    whole += !has_error(problems);
    for (const Diagnostic& problem : problems)
      EXPECT_TRUE(expected.contains(problem.code)) << to_text(problem);
  }
  EXPECT_GT(whole, 100);
}

TEST(Graphs, OfTheRepositoryLoadAndSaveAsTheyAre) {
  int count = 0;
  for (const char* folder : {"graphs", "tests/main_job", "tests/farm"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(KINEGRAPH_SOURCE_DIR) / folder)) {
      if (!entry.path().string().ends_with(".kg.json")) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      const ReadResult read = read_document(text, entry.path().string(), registry());
      EXPECT_TRUE(read.problems.empty()) << all_text(read.problems);
      EXPECT_EQ(write_document(read.document, registry()), text) << entry.path();
      ++count;
    }
  EXPECT_GE(count, 15);
}

}  // namespace
}  // namespace kinegraph
