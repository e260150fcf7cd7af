#include "graph/reference.h"

#include <gmock/gmock.h>

#include "graph/file/dot.h"
#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

TEST(Reference, ListsEveryType) {
  const Registry registry = toys::registry();
  const std::string list = reference_list(registry), markdown = reference_markdown(registry);
  const Json json = reference_json(registry);
  for (const std::string& name : registry.names()) {
    EXPECT_THAT(list, HasSubstr("  " + name + " "));
    EXPECT_THAT(markdown, HasSubstr("### " + name + "\n"));
    EXPECT_NE(json.find("nodes")->find(name), nullptr);
  }
}

TEST(Reference, TellsAllOfAType) {
  const Registry registry = toys::registry();
  const std::string text = reference_text(*registry.find("StyleTransfer"));
  EXPECT_THAT(text, HasSubstr("own: Stats, optional"));
  EXPECT_THAT(text, HasSubstr("motion: Motion\n      m. When disabled: passes on motion."));
  EXPECT_THAT(text, HasSubstr("amount = 1: a number from 0 to 1\n      how much"));
  EXPECT_THAT(text, HasSubstr("root = \"both\": one of both, travel, none"));
  EXPECT_THAT(text, HasSubstr("component: which — a whole number from 1 to 99, required"));
  const Json json = reference_json(*registry.find("Load"));
  EXPECT_EQ(json.find("params")->array()[1].find("max")->number(), 1000);
  EXPECT_EQ(json.find("params")->array()[1].find("unit")->string(), "Hz");
}

TEST(Dot, DrawsNodesLinksAndFrames) {
  const Registry registry = toys::registry();
  const Document document = toys::document_of(
      toys::with_nodes(
          R"("a": {"type": "Load", "note": "x|y"}, "b": {"type": "QuatStats", "enabled": false, "inputs":
        {"motion": "a.motion"}}, "c": {"type": "Gone", "inputs": {"in": "b.stats"}})",
          R"(, "ui": {"frames": {"f": {"title": "F \"1\"", "nodes": ["a"]}}})"),
      registry);
  EXPECT_EQ(dot_text(document, registry), R"(digraph kinegraph {
  rankdir=LR;
  node [shape=record, fontname="sans-serif", fontsize=10];
  "a" [label="{{}|a\nLoad\nx\|y|{<o_motion> motion|<o_points> points}}"];
  "b" [label="{{<i_motion> motion}|b\nQuatStats|{<o_stats> stats}}", style=dashed, color=gray50, fontcolor=gray50];
  "c" [label="{{<i_in> in}|c\nGone|{}}", style=dashed, color=red];
  subgraph cluster_0 {
    label="F \"1\"";
    "a";
  }
  "a":"o_motion":e -> "b":"i_motion":w;
  "b":"o_stats":e -> "c":"i_in":w;
}
)");
}

}  // namespace
}  // namespace kinegraph
