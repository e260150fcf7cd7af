// Graphs as programs make them: a hundred thousand nodes in a row, or around one. They would overflow the
// stack of a walk that calls itself, and take hours of one that looks at every node for every node.
#include <gtest/gtest.h>

#include <functional>

#include "graph/links.h"
#include "graph/nested.h"
#include "graph/plan.h"
#include "graph/validate.h"
#include "tests/graph/toy_graphs.h"
#include "tests/graph/toys.h"

namespace kinegraph {
namespace {

constexpr int many = 100'000;

std::string name_of(int i) {
  return "n" + std::to_string(i);
}
// "a" is a Load; `node(i, before)` is the text of the one that takes the output `before`.
std::string chain(const std::function<std::string(int, const std::string&)>& node,
                  const std::string& output) {
  std::string text = R"("a": {"type": "Load"})", before = "a.motion";
  for (int i = 0; i < many; ++i) {
    text += ", \"" + name_of(i) + "\": " + node(i, before);
    before = name_of(i) + "." + output;
  }
  return text + R"(, "s": {"type": "QuatStats", "inputs": {"motion": ")" + before + "\"}}";
}
std::string linked(const std::string& type, const std::string& port, const std::string& links,
                   const std::string& more = {}) {
  return "{\"type\": \"" + type + "\", " + more + "\"inputs\": {\"" + port + "\": " + links + "}}";
}
std::string as_text(const std::string& text) {
  return "\"" + text + "\"";
}

class LongChains : public testing::Test {
 protected:
  ReadResult judged(const std::string& nodes) {
    return read_and_validate(toys::with_nodes(nodes), registry_, {.file = "g.kg.json", .check_files = false});
  }
  // What the last node's input comes from.
  std::string source_of_last(const std::string& nodes) {
    const ReadResult read = judged(nodes);
    EXPECT_FALSE(has_error(read.problems)) << toys::all_text(read.problems);
    Diagnostics problems;
    const Plan plan =
        make_plan(read.document, registry_, {.file = "g.kg.json", .folder = "/graphs"}, problems);
    const auto& inputs = plan.nodes.at(static_cast<std::size_t>(plan.by_name.at("s"))).inputs.at("motion");
    const Source& source = inputs.front();
    return plan.nodes.at(static_cast<std::size_t>(source.node)).name + "." + source.port;
  }

  Registry registry_ = toys::registry();
};

TEST_F(LongChains, OfDots) {
  const std::string nodes =
      chain([](int, const std::string& before) { return linked("Dot", "input", as_text(before)); }, "output");
  EXPECT_EQ(source_of_last(nodes), "a.motion");
  const Document document = judged(nodes).document;
  EXPECT_EQ(type_of_output(document, registry_, {name_of(many - 1), "output", {}}), "Motion");
  EXPECT_FALSE(objection_to_link(document, registry_, {"a", "motion", {}}, "n0", "input"));
  EXPECT_TRUE(objection_to_link(document, registry_, {"a", "points", {}}, "n0", "input"));
}

TEST_F(LongChains, OfSwitches) {
  EXPECT_EQ(source_of_last(chain(
                [](int, const std::string& before) {
                  return linked("Switch", "inputs", "[" + as_text(before) + ", \"a.motion\"]");
                },
                "output")),
            "a.motion");
}

TEST_F(LongChains, OfDisabledNodes) {
  EXPECT_EQ(source_of_last(chain(
                [](int, const std::string& before) {
                  return linked("Aged", "motion", as_text(before), R"("version": 3, "enabled": false, )");
                },
                "motion")),
            "a.motion");
}

TEST_F(LongChains, ACircleOfManyNamesItsEndsAndHowLongItIs) {
  std::string nodes;
  for (int i = 0; i < many; ++i)
    nodes += (i ? ", " : "") + as_text(name_of(i)) + ": " +
             linked("Dot", "input", as_text(name_of((i + 1) % many) + ".output"));
  const Diagnostics problems = judged(nodes).problems;
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems.front().code, "cycle");
  EXPECT_LT(problems.front().message.size(), 200u);
  EXPECT_NE(problems.front().message.find("(99988 more)"), std::string::npos) << problems.front().message;
}

TEST_F(LongChains, ManyThatLinkOneAndManyThatOneLinks) {
  std::string nodes = R"("a": {"type": "Load"}, "d": {"type": "Dot", "inputs": {"input": "a.motion"}})",
              links;
  for (int i = 0; i < many; ++i) {
    nodes += ", \"" + name_of(i) + "\": " + linked("Dot", "input", "\"d.output\"");
    links += (i ? ", " : "") + as_text(name_of(i) + ".output");
  }
  nodes += ", \"w\": " + linked("Switch", "inputs", "[" + links + "]");
  nodes += R"(, "s": {"type": "QuatStats", "inputs": {"motion": "w.output"}})";
  EXPECT_EQ(source_of_last(nodes), "a.motion");
}

// Each is told; a name that was meant is looked for only for the first of them.
TEST_F(LongChains, ManyLinksToNodesThatAreNot) {
  std::string nodes = R"("a": {"type": "Load"})";
  for (int i = 0; i < many / 5; ++i)
    nodes += ", \"" + name_of(i) +
             "\": " + linked("QuatStats", "motion", as_text("o" + std::to_string(i) + ".motion"));
  const Diagnostics problems = judged(nodes).problems;
  EXPECT_EQ(problems.size(), static_cast<std::size_t>(many / 5));
  EXPECT_EQ(problems.front().hint, "did you mean \"n0\"?");
  EXPECT_EQ(problems.back().hint, "");
}

// The file is read once, and every node of it stands in the plan for itself.
TEST_F(LongChains, OfGraphNodesOfOneFile) {
  constexpr int graphs = 5000;
  const std::string inner = toys::with_nodes(
      R"("l": {"type": "Load"}, "m": {"type": "Aged", "version": 3, "inputs": {"motion": "l.motion"}})",
      R"(, "publish": {"inputs": {"in": "m.motion"}, "outputs": {"out": "m.motion"}})");
  std::string nodes = R"("a": {"type": "Load"})", before = "a.motion";
  for (int i = 0; i < graphs; ++i) {
    nodes += ", \"" + name_of(i) +
             "\": " + linked("Graph", "in", as_text(before), R"("params": {"file": "inner.kg.json"}, )");
    before = name_of(i) + ".out";
  }
  Document document = read_document(toys::with_nodes(nodes), "g.kg.json", registry_).document;
  int reads = 0;
  open_nested(document, registry_,
              {.path = "/graphs/g.kg.json", .folder = "/graphs", .read = [&](const std::string&) {
                 ++reads;
                 return inner;
               }});
  EXPECT_EQ(reads, 1);
  EXPECT_FALSE(has_error(validate(document, registry_, {.file = "g.kg.json", .check_files = false})));
  Diagnostics problems;
  const Plan plan = make_plan(document, registry_, {.file = "g.kg.json", .folder = "/graphs"}, problems);
  EXPECT_EQ(plan.nodes.size(), 1u + 2 * graphs);
  const auto& last = plan.nodes.at(static_cast<std::size_t>(plan.by_name.at(name_of(graphs - 1) + "/m")));
  const Source& source = last.inputs.at("motion").front();
  EXPECT_EQ(plan.nodes.at(static_cast<std::size_t>(source.node)).name, name_of(graphs - 2) + "/m");
}

}  // namespace
}  // namespace kinegraph
