#include "graph/plan.h"

#include <gmock/gmock.h>

#include <functional>

#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

class Planning : public testing::Test {
 protected:
  const Plan& plan(const std::string& nodes, const std::string& rest = {}) {
    document_ = toys::document_of(toys::with_nodes(nodes, rest), registry_);
    problems_.clear();
    plan_ = make_plan(document_, registry_, options_, problems_);
    return plan_;
  }
  const PlannedNode& node(const std::string& name) const { return plan_.nodes.at(plan_.by_name.at(name)); }
  // "node.port", a constant's id, or "absent", of each source of a port.
  std::string shown(const std::optional<Source>& source) const {
    if (!source) return "absent";
    if (source->node < 0) return source->constant ? source->constant_id : "no constant";
    return plan_.nodes.at(source->node).name + "." + source->port;
  }
  std::string sources(const std::string& name, const std::string& port) const {
    std::string text;
    const auto found = node(name).inputs.find(port);
    if (found == node(name).inputs.end()) return "open";
    for (const Source& source : found->second) text += (text.empty() ? "" : " ") + shown(source);
    return text;
  }
  std::vector<std::string> codes() const {
    std::vector<std::string> all;
    for (const Diagnostic& problem : problems_) all.push_back(problem.code);
    return all;
  }
  using Codes = std::vector<std::string>;

  Registry registry_ = toys::registry();
  PlanOptions options_{.file = "g.kg.json", .folder = "/graphs", .set_folder = "/here", .out = "/out"};
  Document document_;
  Diagnostics problems_;
  Plan plan_;
};

const char* const two = R"("a": {"type": "Load"}, "b": {"type": "Load"}, )";

TEST_F(Planning, ParametersAreCompleteAndPathsAbsolute) {
  plan(
      R"("a": {"type": "Load", "params": {"file": "clips/a.bvh"}}, "o": {"type": "Export", "params": {"file": "x/o.bvh"},
       "inputs": {"motion": "a.motion"}}, "p": {"type": "Load", "params": {"file": "/abs/p.bvh"}})");
  EXPECT_EQ(problems_.size(), 0u);
  EXPECT_EQ(compact(node("a").params),
            R"({"file": "/graphs/clips/a.bvh", "fps": 0, "range": [0, null], "unit": "auto"})");
  EXPECT_EQ(node("a").shown_paths.at("file"), "clips/a.bvh");
  EXPECT_EQ(node("o").params.at("file"), Json("/out/x/o.bvh"));
  EXPECT_EQ(node("p").params.at("file"), Json("/abs/p.bvh"));
  EXPECT_EQ(plan_.effects, std::vector<std::string>{"o"});
}

TEST_F(Planning, EqualMeaningGivesEqualParameters) {
  plan(
      R"("a": {"type": "StyleTransfer", "params": {"amount": 0.50, "edits": [{"op": "scale", "component": 1.0}]}},
       "b": {"type": "StyleTransfer", "params": {"amount": "${half}", "edits": [{"component": 1, "op": "scale", "factor": 1, "keys": []}],
       "heading": true}})",
      R"(, "variables": {"half": 5e-1})");
  EXPECT_EQ(compact(node("a").params, true), compact(node("b").params, true));
}

TEST_F(Planning, VariablesGivenByHandComeBeforeTheFiles) {
  options_.variables = {{"take", Json("7")}, {"rate", Json("25")}};
  plan(R"("a": {"type": "Load", "params": {"file": "${show}/take_${take}.bvh", "fps": "${rate}"}})",
       R"(, "variables": {"show": "s1", "take": 3, "rate": 30})");
  EXPECT_EQ(node("a").params.at("file"), Json("/graphs/s1/take_7.bvh"));
  EXPECT_EQ(node("a").params.at("fps"), Json(25));
}

TEST_F(Planning, ADollarIsWrittenTwice) {
  plan(
      R"("a": {"type": "Load", "params": {"file": "$${x}/$5"}}, "b": {"type": "StyleTransfer", "params": {"joints": "$${x}"}})");
  EXPECT_EQ(node("a").params.at("file"), Json("/graphs/${x}/$5"));
  EXPECT_EQ(node("b").params.at("joints"), Json("${x}"));
}

TEST_F(Planning, ABatchsVariablesMustBeSetByThen) {
  plan(R"("o": {"type": "Export", "params": {"file": "${item}.bvh"}})");
  EXPECT_EQ(codes(), Codes{"undefined-variable"});
  options_.variables = {{"item", Json("a/b")}};
  plan(R"("o": {"type": "Export", "params": {"file": "${item}.bvh"}})");
  EXPECT_EQ(node("o").params.at("file"), Json("/out/a/b.bvh"));
}

TEST_F(Planning, SetReplacesParametersByNodeOrPublishedName) {
  options_.sets = {
      {"a.fps", "24"}, {"clip", "mine/b.bvh"}, {"rates", "12"}, {"a.range", "10:20"}, {"o.file", "o2.bvh"}};
  plan(R"("a": {"type": "Load"}, "b": {"type": "Load", "params": {"file": "b.bvh"}}, "c": {"type": "Load"},
       "o": {"type": "Export"})",
       R"(, "publish": {"params": {"clip": "b.file", "rates": ["b.fps", "c.fps"]}})");
  EXPECT_EQ(codes(), Codes{});
  EXPECT_EQ(node("a").params.at("fps"), Json(24));
  EXPECT_EQ(node("a").params.at("range"), Json(Json::Array{10, 20}));
  EXPECT_EQ(node("b").params.at("file"), Json("/here/mine/b.bvh")) << "from the current folder";
  EXPECT_EQ(node("b").params.at("fps"), Json(12));
  EXPECT_EQ(node("c").params.at("fps"), Json(12));
  EXPECT_EQ(node("o").params.at("file"), Json("/out/o2.bvh")) << "from --out";
  EXPECT_EQ(plan_.set_paths, (std::vector<std::string>{"/here/mine/b.bvh", "/out/o2.bvh"}));
}

TEST_F(Planning, AWrongSetIsWrongUsage) {
  options_.sets = {{"x.fps", "1"}, {"a.fpz", "1"}, {"nothing", "1"}, {"a.fps", "fast"}, {"a.range", "20:10"}};
  plan(R"("a": {"type": "Load"})");
  EXPECT_EQ(codes(), (Codes{"usage:unknown-node", "usage:unknown-param", "usage:unknown-param",
                            "usage:bad-value", "usage:bad-range"}));
  EXPECT_THAT(problems_[1].hint, HasSubstr("fps"));
}

TEST_F(Planning, ADotIsReplacedByWhatIsLinkedToIt) {
  plan(
      std::string(two) +
      R"("d": {"type": "Dot", "inputs": {"input": "a.motion"}}, "e": {"type": "Dot", "inputs": {"input": "d.output"}},
       "s": {"type": "QuatStats", "inputs": {"motion": "e.output"}})");
  EXPECT_EQ(sources("s", "motion"), "a.motion");
  EXPECT_EQ(plan_.by_name.count("d"), 0u);
  EXPECT_EQ(shown(plan_.find_output("e", "output")), "a.motion");
}

TEST_F(Planning, ADotWithNothingLinkedIsAbsent) {
  plan(std::string(two) +
       R"("d": {"type": "Dot"}, "s": {"type": "QuatStats", "inputs": {"motion": "d.output"}},
       "o": {"type": "Export", "inputs": {"motion": "d.output", "points": "a.points"}})");
  EXPECT_EQ(sources("s", "motion"), "open");
  EXPECT_THAT(node("s").blocked, HasSubstr("d.output"));
  EXPECT_EQ(node("o").blocked, "") << "an optional input counts as open";
  EXPECT_EQ(shown(plan_.find_output("d", "output")), "absent");
  EXPECT_EQ(plan_.passed.count("d"), 1u);
}

TEST_F(Planning, ASwitchIsReplacedByTheLinkItChooses) {
  const std::string graph =
      std::string(two) +
      R"("w": {"type": "Switch", "params": {"index": 1}, "inputs": {"inputs": ["a.motion", "b.motion"]}},
       "s": {"type": "QuatStats", "inputs": {"motion": "w.output"}})";
  plan(graph);
  EXPECT_EQ(sources("s", "motion"), "b.motion");
  options_.sets = {{"w.index", "0"}};
  plan(graph);
  EXPECT_EQ(sources("s", "motion"), "a.motion");
  options_.sets = {{"w.index", "2"}};
  plan(graph);
  EXPECT_EQ(codes(), Codes{"index-out-of-range"});
}

TEST_F(Planning, ADisabledNodePassesOnWhatTheRegistrySays) {
  plan(
      std::string(two) +
          R"("t": {"type": "TimeWarp", "enabled": false, "inputs": {"source": "a.motion", "reference": "b.motion"}},
       "c": {"type": "Concatenate", "inputs": {"motions": ["t.reference", "t.warped"]}})",
      R"(, "publish": {"outputs": {"w": "t.warp", "m": "t.warped"}})");
  EXPECT_EQ(sources("c", "motions"), "b.motion a.motion");
  EXPECT_EQ(shown(plan_.published.at("w")), "TimeWarp.warp");
  EXPECT_EQ(shown(plan_.published.at("m")), "a.motion");
  EXPECT_FALSE(node("t").enabled);
}

TEST_F(Planning, ADisabledListNodePassesItsFirstLinkAndOneWithoutRuleIsAbsent) {
  plan(std::string(two) +
       R"("c": {"type": "Concatenate", "enabled": false, "inputs": {"motions": ["b.motion", "a.motion"]}},
       "s": {"type": "QuatStats", "enabled": false, "inputs": {"motion": "c.motion"}},
       "t": {"type": "StyleTransfer", "inputs": {"motion": "c.motion", "style": "s.stats", "own": "s.stats"}},
       "l": {"type": "Concatenate", "inputs": {"motions": ["a.motion", "off.motion"]}},
       "off": {"type": "Load", "enabled": false})");
  EXPECT_EQ(sources("t", "motion"), "b.motion");
  EXPECT_EQ(sources("t", "style"), "open");
  EXPECT_EQ(sources("t", "own"), "open");
  EXPECT_THAT(node("t").blocked, HasSubstr("style"));
  EXPECT_EQ(sources("l", "motions"), "a.motion");
  EXPECT_EQ(node("l").blocked, "");
}

TEST_F(Planning, AConstantIsMadeOnce) {
  plan(R"("t": {"type": "TimeWarp", "enabled": false}, "u": {"type": "TimeWarp", "enabled": false})",
       R"(, "publish": {"outputs": {"v": "t.warp", "w": "u.warp"}})");
  EXPECT_EQ(plan_.published.at("v").constant, plan_.published.at("w").constant);
}

TEST_F(Planning, MissingNodesStayInTheWay) {
  plan(R"("f": {"type": "Future"}, "g": {"type": "Future", "enabled": false},
       "s": {"type": "QuatStats", "inputs": {"motion": "f.motion"}}, "t": {"type": "QuatStats", "inputs": {"motion": "g.motion"}})");
  EXPECT_EQ(node("f").type, nullptr);
  EXPECT_EQ(node("f").type_name, "Future");
  EXPECT_EQ(sources("s", "motion"), "f.motion");
  EXPECT_EQ(sources("t", "motion"), "open");
}

TEST_F(Planning, DisabledWritersHaveNoEffect) {
  plan(std::string(two) + R"("o": {"type": "Export", "enabled": false, "inputs": {"motion": "a.motion"}},
       "p": {"type": "Export", "inputs": {"motion": "a.motion"}}, "k": {"type": "Check", "inputs": {"metrics": "m.metrics"}},
       "m": {"type": "Metrics", "inputs": {"motion": "a.motion"}})");
  EXPECT_EQ(plan_.effects, (std::vector<std::string>{"k", "p"}));
}

TEST_F(Planning, ACycleOfDotsDoesNotHangIt) {
  plan(
      R"("d": {"type": "Dot", "inputs": {"input": "e.output"}}, "e": {"type": "Dot", "inputs": {"input": "d.output"}})");
  EXPECT_EQ(shown(plan_.find_output("d", "output")), "absent");
}

TEST(Registry, RefusesDescriptionsThatContradictThemselves) {
  const auto refuses = [](const std::function<void(NodeType&)>& spoil) {
    Registry registry;
    registry.add(ValueType{.name = "Motion", .help = "m"});
    NodeType type = toys::bare("X");
    type.input("in", {"Motion"}, "i")
        .output("out", "Motion", "o", "in")
        .param("p", number(1).between(0, 2), "p");
    spoil(type);
    EXPECT_THROW(registry.add(std::move(type)), std::logic_error);
  };
  refuses([](NodeType& type) { type.name = "a b"; });
  refuses([](NodeType& type) { type.inputs[0].types = {"Nothing"}; });
  refuses([](NodeType& type) { type.outputs[0].type = "Nothing"; });
  refuses([](NodeType& type) { type.outputs[0].passes = "nothing"; });
  refuses([](NodeType& type) { type.input("in", {"Motion"}, "again"); });
  refuses([](NodeType& type) { type.param("p", number(0), "again"); });
  refuses([](NodeType& type) { type.params[0].fallback = Json(3); });
  refuses([](NodeType& type) { type.params[0].fallback.reset(); });
  refuses([](NodeType& type) { type.params[0].soft_max = 3; });
  refuses([](NodeType& type) { type.version = 2; });
  refuses([](NodeType& type) { type.compute = nullptr; });
  refuses([](NodeType& type) { type.param("q", list(object({number(5).between(0, 1).as("f", "")})), "q"); });
  Registry registry = toys::registry();
  EXPECT_THROW(registry.add(toys::bare("Load")), std::logic_error);
  EXPECT_THROW(registry.add(ValueType{.name = "Motion", .help = "m"}), std::logic_error);
}

}  // namespace
}  // namespace kinegraph
