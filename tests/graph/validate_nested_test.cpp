// What stands in a graph's way inside the graph files that it uses.
#include "graph/validate_nested.h"

#include <gtest/gtest.h>

#include "graph/nested.h"
#include "tests/graph/toy_graphs.h"
#include "tests/graph/toys.h"

namespace kinegraph {
namespace {

// "sample" reads a clip that isn't there and is replaced where the Graph node is linked; "own" always reads
// one.
constexpr const char* styled = R"("sample": {"type": "Load", "params": {"file": "sample.bvh"}},
"own": {"type": "Load", "params": {"file": "own.bvh"}},
"stats": {"type": "QuatStats", "inputs": {"motion": "own.motion"}},
"transfer": {"type": "StyleTransfer", "inputs": {"motion": "sample.motion", "style": "stats.stats"}},
"out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "unasked.motion"}},
"unasked": {"type": "Load", "params": {"file": "unasked.bvh"}})";
constexpr const char* published = R"(, "publish": {"inputs": {"motion": "transfer.motion"},
"outputs": {"motion": "transfer.motion"}, "params": {"style": "own.file"}})";

class ValidateNested : public testing::Test {
 protected:
  std::vector<std::string> problems_of(const std::string& outer_nodes, bool check_files = true) {
    Document document = toys::document_of(toys::with_nodes(outer_nodes), registry_);
    open_nested(document, registry_,
                {.path = folder_ / "g.kg.json", .folder = folder_.path, .read = toys::content});
    std::vector<std::string> all;
    for (const Diagnostic& problem :
         validate_nested(document, registry_,
                         {.file = "in/g.kg.json", .folder = folder_.path, .check_files = check_files}))
      all.push_back(problem.file + ":" + std::to_string(problem.place.line) + " " + problem.code + " " +
                    problem.node + (problem.param.empty() ? "" : "." + problem.param));
    return all;
  }
  using Told = std::vector<std::string>;
  toys::Folder folder_;
  Registry registry_ = toys::registry();
};

TEST_F(ValidateNested, AClipThatIsNotThereIsToldWithItsFileItsLineAndTheWayThere) {
  toys::write(folder_ / "lib/styled.kg.json", toys::with_nodes(styled, published));
  EXPECT_EQ(problems_of(R"("g": {"type": "Graph", "params": {"file": "lib/styled.kg.json"}})"),
            (Told{"in/lib/styled.kg.json:1 missing-file g/sample.file",
                  "in/lib/styled.kg.json:2 missing-file g/own.file"}));
}

TEST_F(ValidateNested, WhatTheOuterFileReplacesIsNotLookedFor) {
  toys::write(folder_ / "lib/styled.kg.json", toys::with_nodes(styled, published));
  EXPECT_EQ(problems_of(R"("w": {"type": "Load", "params": {"file": "w.bvh"}},
"g": {"type": "Graph", "params": {"file": "lib/styled.kg.json", "style": "there.bvh"}, "inputs": {"motion": "w.motion"}})"),
            Told{});
}

TEST_F(ValidateNested, TwoFilesDeepTheWayNamesBothGraphNodesAndVariablesComeFromOutside) {
  toys::write(
      folder_ / "a/outer.kg.json",
      toys::with_nodes(R"("inner": {"type": "Graph", "params": {"file": "../b/inner.kg.json"}})",
                       R"(, "variables": {"who": "nobody"}, "publish": {"outputs": {"m": "inner.m"}})"));
  toys::write(folder_ / "b/inner.kg.json",
              toys::with_nodes("\n\n\"l\": {\"type\": \"Load\", \"params\": {\"file\": \"${who}.bvh\"}}",
                               R"(, "publish": {"outputs": {"m": "l.motion"}})"));
  const std::string outer = R"("g": {"type": "Graph", "params": {"file": "a/outer.kg.json"}})";
  EXPECT_EQ(problems_of(outer), Told{"in/b/inner.kg.json:3 missing-file g/inner/l.file"});
  toys::write(folder_ / "b/nobody.bvh", "");
  EXPECT_EQ(problems_of(outer), Told{});
}

TEST_F(ValidateNested, AnUnknownTypeIsToldEvenWhenNoFilesAreLookedFor) {
  toys::write(folder_ / "lib/odd.kg.json",
              toys::with_nodes("\"l\": {\"type\": \"Laod\"},\n\"t\": {\"type\": \"QuatSats\"}",
                               R"(, "publish": {"outputs": {"m": "l.motion"}})"));
  EXPECT_EQ(problems_of(R"("g": {"type": "Graph", "params": {"file": "lib/odd.kg.json"}})", false),
            Told{"in/lib/odd.kg.json:1 unknown-type g/l"});
}

// Else it would be opened until the system follows no more links.
TEST_F(ValidateNested, AFileInsideItselfByWayOfALinkIsACircle) {
  std::filesystem::create_directory_symlink(".", folder_ / "again");
  const std::string text =
      toys::with_nodes(R"("g": {"type": "Graph", "params": {"file": "again/g.kg.json"}})",
                       R"(, "publish": {"outputs": {"m": "g.m"}})");
  toys::write(folder_ / "g.kg.json", text);
  Document document = toys::document_of(text, registry_);
  open_nested(document, registry_,
              {.path = folder_ / "g.kg.json", .folder = folder_.path, .read = toys::content});
  ASSERT_TRUE(document.nodes.at("g").nested);
  EXPECT_EQ(document.nodes.at("g").nested->why.code, "graph-cycle");
}

TEST_F(ValidateNested, OfADisabledGraphNodeNothingIsSaid) {
  toys::write(folder_ / "lib/styled.kg.json", toys::with_nodes(styled, published));
  EXPECT_EQ(
      problems_of(R"("g": {"type": "Graph", "enabled": false, "params": {"file": "lib/styled.kg.json"}})"),
      Told{});
}

}  // namespace
}  // namespace kinegraph
