// Graph files inside graphs: what is published, what that makes of a Graph node, and that nesting changes
// nothing else.
#include "graph/nested.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "graph/plan.h"
#include "graph/validate.h"
#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Nesting : public testing::Test {
 protected:
  void file(const std::string& path, const std::string& nodes, const std::string& rest = {}) {
    files_["/g/" + path] = toys::with_nodes(nodes, rest);
  }
  // Reads /g/main.kg.json and all inside it.
  void open() {
    ReadResult read = read_document(files_.at("/g/main.kg.json"), "main.kg.json", registry_);
    document_ = std::move(read.document);
    NestedOptions options{.path = "/g/main.kg.json",
                          .folder = "/g",
                          .set_folder = "/here",
                          .variables = variables_,
                          .files = set_files_};
    options.read = [this](const std::string& path) {
      const auto found = files_.find(path);
      if (found == files_.end()) throw Failure(error("missing-file", "it does not exist"));
      return found->second;
    };
    open_nested(document_, registry_, options);
  }
  std::vector<std::string> problems(bool check_files = false) {
    open();
    std::vector<std::string> all;
    told_.clear();
    for (const Diagnostic& problem : validate(
             document_, registry_,
             {.file = "main.kg.json", .folder = "/g", .check_files = check_files, .variables = variables_})) {
      all.push_back(std::string(name_of(problem.severity)) + " " + problem.code + " " + problem.node);
      told_ += to_text(problem) + "\n";
    }
    return all;
  }
  const Plan& plan() {
    open();
    planned_.clear();
    plan_ = make_plan(document_, registry_,
                      {.file = "main.kg.json",
                       .folder = "/g",
                       .set_folder = "/here",
                       .out = "/out",
                       .variables = variables_,
                       .sets = sets_},
                      planned_);
    for (const auto& problem : planned_) ADD_FAILURE() << to_text(problem);
    return plan_;
  }
  const PlannedNode& node(const std::string& name) const {
    return plan_.nodes.at(static_cast<std::size_t>(plan_.by_name.at(name)));
  }
  std::string shown(const std::optional<Source>& source) const {
    return source ? plan_.nodes.at(static_cast<std::size_t>(source->node)).name + "." + source->port
                  : "absent";
  }
  std::string source(const std::string& name, const std::string& port) const {
    const auto found = node(name).inputs.find(port);
    return found == node(name).inputs.end() ? "open" : shown(found->second.at(0));
  }

  Registry registry_ = toys::registry();
  std::map<std::string, std::string> files_, set_files_;
  std::map<std::string, Json> variables_;
  std::vector<std::pair<std::string, std::string>> sets_;
  Document document_;
  Plan plan_;
  Diagnostics planned_;
  std::string told_;
};

// Restyle: the style's clip is its own sample, the motion comes from outside.
const char* const restyle = R"("sample": {"type": "Load", "params": {"file": "clips/proud.bvh"}},
  "stats": {"type": "QuatStats", "inputs": {"motion": "sample.motion"}},
  "transfer": {"type": "StyleTransfer", "params": {"amount": 0.5}, "inputs": {"style": "stats.stats"}})";
const char* const restyle_published =
    R"(, "publish": {"inputs": {"motion": "transfer.motion", "style": "stats.motion"},
  "outputs": {"motion": "transfer.motion"}, "params": {"amount": "transfer.amount", "clip": "sample.file"}})";
const char* const main_nodes = R"("walk": {"type": "Load", "params": {"file": "walk.bvh"}},
  "proud": {"type": "Graph", "params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"}},
  "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "proud.motion"}})";

TEST_F(Nesting, AGraphNodeHasWhatItsFilePublishes) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file("main.kg.json", main_nodes);
  EXPECT_THAT(problems(), IsEmpty()) << told_;
  const NodeType* type = known_type(registry_, document_.nodes.at("proud"));
  ASSERT_NE(type, nullptr);
  EXPECT_THAT(type->input_names(), ElementsAre("motion", "style"));
  EXPECT_FALSE(type->find_input("motion")->optional);
  EXPECT_TRUE(type->find_input("style")->optional);
  EXPECT_THAT(type->output_names(), ElementsAre("motion"));
  EXPECT_EQ(type->find_output("motion")->type, "Motion");
  EXPECT_EQ(type->find_output("motion")->passes, "motion");
  EXPECT_EQ(*type->find_param("amount")->fallback, Json(0.5));
}

TEST_F(Nesting, ThePlanHoldsTheInnerNodesUnderTheGraphNodesName) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file("main.kg.json", main_nodes);
  plan();
  EXPECT_EQ(source("out", "motion"), "proud/transfer.motion");
  EXPECT_EQ(source("proud/transfer", "motion"), "walk.motion");
  EXPECT_EQ(source("proud/stats", "motion"), "proud/sample.motion");
  EXPECT_EQ(node("proud/sample").params.at("file"), Json("/g/lib/clips/proud.bvh"));
  EXPECT_EQ(node("proud/transfer").params.at("amount"), Json(0.5));
  EXPECT_THAT(plan_.graph_files, ElementsAre("/g/lib/restyle.kg.json"));
  EXPECT_THAT(plan_.effects, ElementsAre("out"));
  EXPECT_EQ(shown(plan_.find_output("proud", "motion")), "proud/transfer.motion");
}

TEST_F(Nesting, ALinkFromOutsideReplacesTheSampleAndParametersGoIn) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file("main.kg.json", R"("walk": {"type": "Load", "params": {"file": "walk.bvh"}},
    "proud": {"type": "Graph", "params": {"file": "lib/restyle.kg.json", "amount": 0.25, "clip": "mine.bvh"},
              "inputs": {"motion": "walk.motion", "style": "walk.motion"}})");
  EXPECT_THAT(problems(), IsEmpty()) << told_;
  plan();
  EXPECT_EQ(source("proud/stats", "motion"), "walk.motion");
  EXPECT_EQ(node("proud/transfer").params.at("amount"), Json(0.25));
  // A path is relative to the file in which it is written.
  EXPECT_EQ(node("proud/sample").params.at("file"), Json("/g/mine.bvh"));
  EXPECT_EQ(node("proud/sample").shown_paths.at("file"), "mine.bvh");
}

TEST_F(Nesting, SetReachesWhatIsPublished) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file("main.kg.json", main_nodes, R"(, "publish": {"params": {"how_much": "proud.amount"}})");
  sets_ = {{"how_much", "0.75"}, {"proud.clip", "set.bvh"}};
  plan();
  EXPECT_EQ(node("proud/transfer").params.at("amount"), Json(0.75));
  EXPECT_EQ(node("proud/sample").params.at("file"), Json("/here/set.bvh"));
  EXPECT_THAT(plan_.set_paths, ElementsAre("/here/set.bvh"));
}

TEST_F(Nesting, PublishesThroughTwoFiles) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file(
      "lib/twice.kg.json", R"("one": {"type": "Graph", "params": {"file": "restyle.kg.json"}},
    "two": {"type": "Graph", "params": {"file": "restyle.kg.json", "amount": 1}, "inputs": {"motion": "one.motion"}})",
      R"(, "publish": {"inputs": {"motion": "one.motion", "style": ["one.style", "two.style"]}, "outputs": {"motion": "two.motion"},
         "params": {"first": "one.amount"}})");
  file("main.kg.json", R"("walk": {"type": "Load"},
    "g": {"type": "Graph", "params": {"file": "lib/twice.kg.json", "first": 0.1}, "inputs": {"motion": "walk.motion", "style": "walk.motion"}})");
  EXPECT_THAT(problems(), IsEmpty()) << told_;
  plan();
  EXPECT_EQ(shown(plan_.find_output("g", "motion")), "g/two/transfer.motion");
  EXPECT_EQ(source("g/two/transfer", "motion"), "g/one/transfer.motion");
  EXPECT_EQ(source("g/one/transfer", "motion"), "walk.motion");
  EXPECT_EQ(source("g/one/stats", "motion"), "walk.motion");
  EXPECT_EQ(source("g/two/stats", "motion"), "walk.motion");
  EXPECT_EQ(node("g/one/transfer").params.at("amount"), Json(0.1));
  EXPECT_EQ(node("g/two/transfer").params.at("amount"), Json(1));
}

TEST_F(Nesting, ADisabledGraphNodePassesOnWhatItsNodesWould) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file("main.kg.json", R"("walk": {"type": "Load"},
    "g": {"type": "Graph", "enabled": false, "params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"}},
    "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "g.motion"}})");
  plan();
  EXPECT_EQ(source("out", "motion"), "walk.motion");
}

TEST_F(Nesting, ExportsInsideDontRun) {
  file(
      "inner.kg.json",
      R"("a": {"type": "Load"}, "o": {"type": "Export", "params": {"file": "x.bvh"}, "inputs": {"motion": "a.motion"}})",
      R"(, "publish": {"outputs": {"m": "a.motion"}})");
  file("main.kg.json", R"("g": {"type": "Graph", "params": {"file": "inner.kg.json"}},
    "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "g.m"}})");
  plan();
  EXPECT_THAT(plan_.effects, ElementsAre("out"));
}

TEST_F(Nesting, VariablesComeFromTheCommandLineThenTheOutermostFile) {
  const char* const inner = R"("a": {"type": "Load", "params": {"file": "${clip}.bvh", "fps": "${rate}"}})";
  const char* const published =
      R"(, "variables": {"clip": "inner", "rate": 10}, "publish": {"outputs": {"m": "a.motion"}})";
  file("inner.kg.json", inner, published);
  file("main.kg.json", R"("g": {"type": "Graph", "params": {"file": "${which}.kg.json"}})",
       R"(, "variables": {"which": "inner", "clip": "outer"})");
  plan();
  EXPECT_EQ(node("g/a").params.at("file"), Json("/g/outer.bvh"));
  EXPECT_EQ(node("g/a").params.at("fps"), Json(10));
  variables_ = {{"rate", Json("24")}};
  plan();
  EXPECT_EQ(node("g/a").params.at("fps"), Json(24));
}

TEST_F(Nesting, AFileThatIsMissingOrBrokenMakesAMissingNode) {
  file("main.kg.json", main_nodes);
  EXPECT_THAT(problems(true), testing::Contains("error missing-file proud"));
  EXPECT_THAT(problems(false), ElementsAre("warning missing-file proud"));
  EXPECT_EQ(known_type(registry_, document_.nodes.at("proud")), nullptr);
  plan();
  EXPECT_EQ(node("proud").type, nullptr);
  EXPECT_THAT(node("proud").missing_because, HasSubstr("restyle.kg.json"));
  // It is saved as it was.
  EXPECT_EQ(write_document(document_, registry_),
            write_document(read_document(files_.at("/g/main.kg.json"), "", registry_).document, registry_));

  file("lib/restyle.kg.json", R"("t": {"type": "QuatStats", "inputs": {"motion": "nobody.motion"}})");
  EXPECT_THAT(problems(true), testing::Contains("error broken-graph proud"));
  EXPECT_THAT(told_, HasSubstr("there is no node \"nobody\""));
}

TEST_F(Nesting, NamesThatAreNotPublishedAreErrors) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file("main.kg.json",
       R"("walk": {"type": "Load"}, "w": {"type": "QuatStats", "inputs": {"motion": "g.moton"}},
    "g": {"type": "Graph", "params": {"file": "lib/restyle.kg.json", "amuont": 1}, "inputs": {"motion": "walk.motion", "styl": "walk.motion"}})");
  EXPECT_THAT(problems(), testing::UnorderedElementsAre("error unknown-param g", "error unknown-port g",
                                                        "error unknown-port w"));
  EXPECT_THAT(told_, HasSubstr("did you mean \"amount\"?"));
  EXPECT_THAT(told_, HasSubstr("did you mean \"style\"?"));
}

TEST_F(Nesting, TypesRangesAndOpenInputsAreCheckedAsOfAnyNode) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file("main.kg.json",
       R"("walk": {"type": "Load"}, "s": {"type": "QuatStats", "inputs": {"motion": "walk.motion"}},
    "a": {"type": "Graph", "params": {"file": "lib/restyle.kg.json", "amount": 2}, "inputs": {"motion": "s.stats"}},
    "b": {"type": "Graph", "params": {"file": "lib/restyle.kg.json"}},
    "c": {"type": "Graph", "params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": ["walk.motion"]}})");
  EXPECT_THAT(problems(), testing::UnorderedElementsAre("error out-of-range a", "error type-mismatch a",
                                                        "error open-input b", "error one-link c"))
      << told_;
}

TEST_F(Nesting, FilesThatUseEachOtherInACircleAreAnError) {
  const char* const published = R"(, "publish": {"outputs": {"m": "g.m"}})";
  file("main.kg.json", R"("g": {"type": "Graph", "params": {"file": "a.kg.json"}})", published);
  file("a.kg.json", R"("g": {"type": "Graph", "params": {"file": "./b.kg.json"}})", published);
  file("b.kg.json", R"("g": {"type": "Graph", "params": {"file": "main.kg.json"}})", published);
  EXPECT_THAT(problems(), ElementsAre("error graph-cycle g"));
  EXPECT_THAT(told_, HasSubstr("main.kg.json → a.kg.json → b.kg.json → main.kg.json"));
  file("main.kg.json", R"("g": {"type": "Graph", "params": {"file": "main.kg.json"}})", published);
  EXPECT_THAT(problems(), ElementsAre("error graph-cycle g"));
}

TEST_F(Nesting, FilesThatMultiplyLevelByLevelEnd) {
  for (int level = 0; level < 40; ++level) {
    const std::string next = "\"file\": \"n" + std::to_string(level + 1) + ".kg.json\"";
    file(level ? "n" + std::to_string(level) + ".kg.json" : "main.kg.json",
         R"("a": {"type": "Graph", "params": {)" + next + R"(}}, "b": {"type": "Graph", "params": {)" + next +
             "}}");
  }
  EXPECT_THAT(problems(), Not(IsEmpty()));
}

TEST_F(Nesting, TheFileItselfMayBeSetOrPublished) {
  file("lib/restyle.kg.json", restyle, restyle_published);
  file("chooser.kg.json", R"("inner": {"type": "Graph"})",
       R"(, "publish": {"inputs": {"motion": "inner.motion"}, "params": {"which": "inner.file"}})");
  file(
      "main.kg.json",
      R"("g": {"type": "Graph", "params": {"file": "chooser.kg.json", "which": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"}}, "walk": {"type": "Load"})");
  open();
  const auto& inside = document_.nodes.at("g").nested->document;
  ASSERT_TRUE(inside) << to_text(document_.nodes.at("g").nested->why);
  EXPECT_EQ(inside->nodes.at("inner").nested->path, "/g/lib/restyle.kg.json");
  file("main.kg.json", R"("g": {"type": "Graph"})");
  set_files_ = {{"g", "../g/lib/restyle.kg.json"}};
  open();
  EXPECT_EQ(document_.nodes.at("g").nested->path, "/g/lib/restyle.kg.json");
}

TEST_F(Nesting, ADotInsideThatIsPublishedLeadsOn) {
  file("inner.kg.json", R"("d": {"type": "Dot"})",
       R"(, "publish": {"inputs": {"x": "d.input"}, "outputs": {"y": "d.output"}})");
  file(
      "main.kg.json",
      R"("a": {"type": "Load"}, "g": {"type": "Graph", "params": {"file": "inner.kg.json"}, "inputs": {"x": "a.motion"}},
    "h": {"type": "Graph", "params": {"file": "inner.kg.json"}},
    "s": {"type": "QuatStats", "inputs": {"motion": "g.y"}}, "t": {"type": "QuatStats", "inputs": {"motion": "h.y"}})");
  plan();
  EXPECT_EQ(source("s", "motion"), "a.motion");
  EXPECT_EQ(source("t", "motion"), "open");
  EXPECT_THAT(node("t").blocked, HasSubstr("h.y gives nothing"));
}

}  // namespace
}  // namespace kinegraph
