// What is saved is what is loaded, for every graph that the grammar of random_graph.h can draw and every
// graph of the repository; and what is edited can be undone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "graph/file/diff.h"
#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/nested.h"
#include "graph/validate.h"
#include "nodes/all_nodes.h"
#include "tests/graph/random_edits.h"
#include "tests/nodes/random_graph.h"
#include "tests/places.h"

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

namespace fs = std::filesystem;
const fs::path source = source_folder();

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
std::vector<fs::path> graphs_in(const fs::path& folder) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::recursive_directory_iterator(source / folder))
    if (entry.path().string().ends_with(".kg.json")) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

// The files of the document's Graph nodes, as if it stood in `folder`.
void open_files(Document& document, const fs::path& folder) {
  open_nested(document, registry(),
              {.folder = folder.string(), .set_folder = folder.string(), .read = content});
}
// What the repository's pipelines make of a Graph node.
std::map<std::string, NodeType> pipelines() {
  Document users;
  for (const fs::path& file : graphs_in("graphs/pipelines")) {
    Node user;
    user.type = "Graph";
    user.params["file"] = "pipelines/" + file.filename().string();
    users.nodes["n" + std::to_string(users.nodes.size())] = std::move(user);
  }
  open_files(users, source / "graphs");
  std::map<std::string, NodeType> all;
  for (const auto& [name, user] : users.nodes)
    all[user.params.at("file").string()] = *known_type(registry(), user);
  return all;
}

TEST(RandomGraphs, TenThousandLoadAndSaveAsTheyAre) {
  const std::map<std::string, NodeType> files = pipelines();
  RandomGraphs graphs(registry(), 20261122, files);
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
  const auto expect_set = [&](const std::string& param) {
    const auto set = graphs.params().find(param);
    EXPECT_TRUE(set != graphs.params().end() && set->second >= 20) << param;
  };
  expect_set("Graph.*");
  for (const auto& [file, type] : files) {
    EXPECT_GT(type.params.size(), 1u) << file << " publishes none";
    for (const Param& param : type.params) expect_set(file + "." + param.name);
  }
  for (const std::string& name : registry().names()) {
    const auto drawn = graphs.drawn().find(name);
    ASSERT_NE(drawn, graphs.drawn().end()) << name;
    EXPECT_GE(drawn->second, 20) << name;
    for (const Param& param : registry().find(name)->params) expect_set(name + "." + param.name);
  }
}

TEST(RandomGraphs, AreValidButForWhatWasLeftOpen) {
  RandomGraphs graphs(registry(), 7);
  const std::set<std::string> expected = {
      "open-input",    "unknown-type",       "newer-version",  "same-file",          "type-mismatch",
      "wrong-type",    "index-out-of-range", "no-file",        "absolute-path",      "bad-choice",
      "bad-range",     "not-an-integer",     "out-of-range",   "undefined-variable", "variable-not-replaced",
      "bad-variable",  "missing-key",        "unknown-key",    "one-link",           "several-inputs",
      "wrong-content", "nothing-to-write",   "unknown-format", "bad-pattern",        "bad-name"};
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
  for (const char* folder : {"graphs", "tests"})
    for (const fs::path& file : graphs_in(folder)) {
      const std::string text = content(file);
      const ReadResult read = read_document(text, file.string(), registry());
      EXPECT_FALSE(has_error(read.problems)) << all_text(read.problems);
      if (!read.migrated) {  // golden files keep the versions of their day
        EXPECT_EQ(write_document(read.document, registry()), text) << file;
      } else {
        EXPECT_NE(file.string().find("golden"), std::string::npos) << file << ": kinegraph upgrade";
      }
      ++count;
    }
  EXPECT_GE(count, 145);
}

RandomEdits edits_of(unsigned seed, RandomGraphs& values) {
  return {seed, registry(), [&values](const Param& param) { return values.value_of(param); }};
}

// A thousand edits on every graph of the repository that people use, undone to its bytes and done again.
TEST(Graphs, OfTheRepositoryAThousandEditsUndoneGiveTheFile) {
  std::array<int, RandomEdits::kinds> made{};
  unsigned seed = 0;
  for (const char* folder :
       {"graphs", "tests/main_job", "tests/farm", "tests/headless", "tests/nodes/golden/aged"})
    for (const fs::path& file : graphs_in(folder)) {
      const std::string text = content(file);
      Document document = read_document(text, file.string(), registry()).document;
      open_files(document, file.parent_path());
      RandomGraphs values(registry(), ++seed);
      RandomEdits edits = edits_of(seed, values);
      History history;
      for (int i = 0; i < 1000; ++i) {
        Edit edit = edits.next(document);
        apply(document, edit);
        history.push(std::move(edit));
      }
      for (int kind = 0; kind < RandomEdits::kinds; ++kind) made[kind] += edits.made(kind);
      const std::string edited = write_document(document, registry());
      while (history.can_undo()) history.undo(document);
      ASSERT_EQ(write_document(document, registry()), text) << file;
      while (history.can_redo()) history.redo(document);
      ASSERT_EQ(write_document(document, registry()), edited) << file;
    }
  for (int kind = 0; kind < RandomEdits::kinds; ++kind) EXPECT_GE(made[kind], 100) << kind;
}

// The same step by step, where a graph of all that the grammar knows is edited.
TEST(RandomGraphs, AThousandEditsUndoneGiveTheSameBytesStepByStep) {
  RandomGraphs graphs(registry(), 4, pipelines());
  Document document;
  while (document.nodes.size() < 9 || document.publish.params.empty() || document.ui.nodes.empty())
    document = graphs.next();
  open_files(document, source / "graphs");
  RandomEdits edits = edits_of(4, graphs);
  History history;
  std::vector<std::string> states{write_document(document, registry())};
  for (int i = 0; i < 1000; ++i) {
    Edit edit = edits.next(document);
    apply(document, edit);
    history.push(std::move(edit));
    states.push_back(write_document(document, registry()));
  }
  for (std::size_t i = states.size() - 1; i-- > 0;) {
    history.undo(document);
    ASSERT_EQ(write_document(document, registry()), states[i]) << "step " << i;
  }
  for (std::size_t i = 1; i < states.size(); ++i) {
    history.redo(document);
    ASSERT_EQ(write_document(document, registry()), states[i]) << "step " << i;
  }
}

}  // namespace
}  // namespace kinegraph
