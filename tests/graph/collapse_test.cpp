// Nodes made into a graph of their own: what is computed stays the same to the last source and parameter.
#include "graph/collapse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "graph/nested.h"
#include "graph/plan.h"
#include "graph/validate.h"
#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

class Collapsing : public testing::Test {
 protected:
  void graph(const std::string& nodes, const std::string& rest = {}) {
    ReadResult read = read_document(toys::with_nodes(nodes, rest), "main.kg.json", registry_);
    for (const auto& problem : read.problems) ADD_FAILURE() << to_text(problem);
    document_ = std::move(read.document);
  }
  // Into a file of the folder /g/parts, and opened again.
  void collapse_into(const std::vector<std::string>& names, const std::string& file) {
    const std::string path = "/g/" + file;
    made_ = collapse(document_, registry_, names, {file, "/g", path.substr(0, path.rfind('/'))});
    files_[path] = write_document(made_.inside, registry_);
    apply(document_, made_.edit);
    open();
  }
  void open() {
    NestedOptions options{.path = "/g/main.kg.json", .folder = "/g", .set_folder = "/g"};
    options.read = [this](const std::string& path) { return files_.at(path); };
    open_nested(document_, registry_, options);
    for (const Diagnostic& problem :
         validate(document_, registry_, {.file = "main.kg.json", .folder = "/g", .check_files = false}))
      ADD_FAILURE() << to_text(problem);
  }
  // Everything that leads to a node, without the names that nesting changes.
  std::string way_to(const std::string& name) {
    Diagnostics problems;
    const Plan plan =
        make_plan(document_, registry_,
                  {.file = "main.kg.json", .folder = "/g", .set_folder = "/g", .out = "/out"}, problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_text(problem);
    return way(plan, plan.by_name.at(name));
  }
  static std::string way(const Plan& plan, int index) {
    const PlannedNode& node = plan.nodes.at(static_cast<std::size_t>(index));
    std::string text = node.type_name + compact(Json(node.params)) + "(";
    for (const auto& [port, sources] : node.inputs)
      for (const Source& source : sources)
        text += port + "<-" + way(plan, source.node) + "." + source.port + " ";
    return text + ")";
  }
  std::string refusal(const std::vector<std::string>& names) {
    try {
      collapse(document_, registry_, names, {"part.kg.json", "/g", "/g"});
    } catch (const Failure& failure) {
      return failure.diagnostic().message;
    }
    return "";
  }

  Registry registry_ = toys::registry();
  std::map<std::string, std::string> files_;
  Document document_;
  Collapsed made_;
};

const char* const nodes = R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
  "proud": {"type": "Load", "params": {"file": "clips/proud.bvh"}},
  "style": {"type": "QuatStats", "inputs": {"motion": "proud.motion"}},
  "own": {"type": "QuatStats", "inputs": {"motion": "walk.motion"}},
  "transfer": {"type": "StyleTransfer", "params": {"amount": 0.5},
    "inputs": {"motion": "walk.motion", "own": "own.stats", "style": "style.stats"}},
  "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "transfer.motion"}})";

TEST_F(Collapsing, LeavesEverythingComputedAsItWas) {
  graph(nodes);
  const std::string before = way_to("out");
  collapse_into({"style", "own", "transfer"}, "part.kg.json");
  EXPECT_EQ(way_to("out"), before);
}

TEST_F(Collapsing, PublishesWhatIsLinkedFromOutside) {
  graph(nodes);
  collapse_into({"style", "own", "transfer"}, "part.kg.json");
  const Node& made = document_.nodes.at(made_.node);
  EXPECT_EQ(made.type, "Graph");
  // The walk goes to two of the nodes: one published input serves both.
  ASSERT_EQ(made_.inside.publish.inputs.size(), 2u);
  std::size_t ports = 0;
  for (const auto& [name, targets] : made_.inside.publish.inputs) ports += targets.size();
  EXPECT_EQ(ports, 3u);
  EXPECT_EQ(made.inputs.size(), 2u);
  ASSERT_EQ(made_.inside.publish.outputs.size(), 1u);
  EXPECT_THAT(document_.nodes.at("out").inputs.at("motion").links,
              ElementsAre(Link{made_.node, "motion", {}}));
}

TEST_F(Collapsing, PathsStartAtTheNewFilesFolder) {
  graph(nodes);
  const std::string before = way_to("out");
  collapse_into({"proud", "style"}, "parts/style.kg.json");
  EXPECT_EQ(made_.inside.nodes.at("proud").params.at("file"), Json("../clips/proud.bvh"));
  std::string after = way_to("out");
  after.replace(after.find("/parts/.."), std::string("/parts/..").size(), "");
  EXPECT_EQ(after, before);
}

TEST_F(Collapsing, WhatThisFilePublishesStaysPublishedThroughTheNewNode) {
  graph(nodes, R"(, "publish": {"inputs": {"style": "style.motion"}, "outputs": {"result": "transfer.motion"},
    "params": {"amount": "transfer.amount", "clip": "proud.file"}})");
  collapse_into({"style", "transfer"}, "part.kg.json");
  EXPECT_THAT(document_.publish.outputs.at("result"), ElementsAre(Link{made_.node, "motion", {}}));
  EXPECT_THAT(document_.publish.params.at("amount"), ElementsAre(Link{made_.node, "amount", {}}));
  EXPECT_THAT(document_.publish.params.at("clip"), ElementsAre(Link{"proud", "file", {}}));
  ASSERT_EQ(document_.publish.inputs.at("style").size(), 1u);
  EXPECT_EQ(document_.publish.inputs.at("style").front().node, made_.node);
}

TEST_F(Collapsing, TheInverseBringsAllBack) {
  graph(nodes, R"(, "ui": {"nodes": {"style": {"pos": [100, 20]}, "transfer": {"pos": [300, 40]}}})");
  const std::string before = write_document(document_, registry_);
  collapse_into({"style", "transfer"}, "part.kg.json");
  EXPECT_EQ(compact(document_.ui.nodes.at(made_.node)), R"({"pos": [200, 30]})");
  apply(document_, inverse(made_.edit));
  EXPECT_EQ(write_document(document_, registry_), before);
}

TEST_F(Collapsing, RefusesWhatCantLieInside) {
  graph(nodes);
  EXPECT_THAT(refusal({}), HasSubstr("no node is chosen"));
  EXPECT_THAT(refusal({"transfer", "out"}), HasSubstr("\"out\" writes or checks"));
  EXPECT_THAT(refusal({"proud", "transfer"}), HasSubstr("\"style\" lies between"));
}

}  // namespace
}  // namespace kinegraph
