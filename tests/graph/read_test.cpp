// What the reader understands: missing nodes, old versions, newer files, extras, and units of what was read.
#include "graph/file/read.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "graph/file/parse_json.h"
#include "graph/links.h"
#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

class Reading : public testing::Test {
 protected:
  ReadResult read(const std::string& nodes, const std::string& rest = {}, bool migrate = true) {
    return read_document(toys::with_nodes(nodes, rest), "g.kg.json", registry_, migrate);
  }
  Registry registry_ = toys::registry();
};

TEST_F(Reading, UnknownTypesAndNewerVersionsAreKeptAndTheRestIsRead) {
  const ReadResult result = read(R"("a": {"type": "Teleport", "enabled": false, "inputs": {"in": "b.motion"}},
    "b": {"type": "Load", "version": 9, "params": {"film": 35}}, "c": {"type": "Load"})");
  EXPECT_FALSE(has_error(result.problems)) << toys::all_text(result.problems);
  ASSERT_EQ(result.problems.size(), 2u);
  const Node& a = result.document.nodes.at("a");
  EXPECT_TRUE(a.missing);
  EXPECT_EQ(a.type, "Teleport");
  EXPECT_FALSE(a.enabled);
  EXPECT_EQ(a.inputs.at("in").links, (std::vector<Link>{{"b", "motion", {}}}));
  EXPECT_TRUE(result.document.nodes.at("b").missing);
  EXPECT_FALSE(result.document.nodes.at("c").missing);
}

TEST_F(Reading, AnOldNodeIsBroughtUpToDate) {
  const ReadResult result = read(
      R"("a": {"type": "Aged", "note": "n", "params": {"speed": 150}, "inputs": {"in": "b.motion"}, "x-k": 1},
    "b": {"type": "Load"})");
  EXPECT_TRUE(result.migrated);
  const Node& a = result.document.nodes.at("a");
  EXPECT_EQ(a.version, 3);
  EXPECT_EQ(a.params.at("rate"), Json(1.5));
  EXPECT_EQ(a.params.count("speed"), 0u);
  EXPECT_EQ(a.inputs.at("motion").links.size(), 1u);
  EXPECT_EQ(a.note, "n");
  EXPECT_EQ(a.extras.at("x-k"), Json(1));
  ASSERT_EQ(result.problems.size(), 1u);
  EXPECT_EQ(result.problems[0].code, "old-version");
  EXPECT_EQ(result.problems[0].severity, Severity::info);
}

TEST_F(Reading, StepsBeforeANodesVersionAreLeftOut) {
  const ReadResult result =
      read(R"("a": {"type": "Aged", "version": 2, "params": {"rate": 2}, "inputs": {"in": "a.motion"}},
    "b": {"type": "Aged", "version": 3, "inputs": {"motion": "a.motion"}})");
  EXPECT_EQ(result.document.nodes.at("a").params.at("rate"), Json(2));
  EXPECT_EQ(result.document.nodes.at("a").inputs.count("motion"), 1u);
  EXPECT_EQ(result.problems.size(), 1u) << toys::all_text(result.problems);
}

TEST_F(Reading, WhatMigrationLeavesUnknownIsToldWhereItStood) {
  const ReadResult result = read("\"a\": {\"type\": \"Aged\",\n\"params\": {\"sped\": 1}}");
  const auto found = std::find_if(result.problems.begin(), result.problems.end(),
                                  [](const Diagnostic& problem) { return problem.code == "unknown-param"; });
  ASSERT_NE(found, result.problems.end());
  EXPECT_EQ(found->place.line, 2);
  EXPECT_EQ(found->place.column, 12);
}

TEST_F(Reading, TheOldAndTheMigratedFileMeanTheSame) {
  const ReadResult old = read(
      R"("a": {"type": "Aged", "params": {"speed": 50}, "inputs": {"in": "b.motion"}}, "b": {"type": "Load"})");
  const std::string written = write_document(old.document, registry_);
  EXPECT_THAT(written, HasSubstr("\"version\": 3"));
  const ReadResult again = read_document(written, "g", registry_);
  EXPECT_TRUE(again.problems.empty());
  EXPECT_EQ(write_document(again.document, registry_), written);
}

TEST_F(Reading, ExtrasAreKeptOnlyWhereThisFormatFixesTheKeys) {
  EXPECT_TRUE(read(R"("a": {"type": "Load", "x-a": {"deep": 1}})",
                   R"(, "x-top": 1, "publish": {"x-p": 1}, "ui": {"x-u": 1, "nodes": {"a": {"x-n": 1}}})")
                  .problems.empty());
  EXPECT_EQ(read(R"("x-a": {"type": "Load"})").document.nodes.count("x-a"), 1u) << "a name like any other";
  EXPECT_EQ(read("", R"(, "variables": {"x-v": 1})").document.variables.count("x-v"), 1u);
  EXPECT_TRUE(has_error(read(R"("a": {"type": "Load", "inputs": {"x-a": "b.c"}})").problems));
}

TEST_F(Reading, EveryKeyAndValueKnowsItsPlace) {
  Diagnostics problems;
  const Json json =
      parse_json("{\n  \"a\" : [1,\n   {\"b\":\t-2.50e1}],\r\n\"é\": \"x\\\"y\" }", "", problems);
  ASSERT_TRUE(problems.empty());
  const auto at = [](Place place) { return std::pair(place.line, place.column); };
  EXPECT_EQ(at(json.find("a")->key_place), std::pair(2, 3));
  EXPECT_EQ(at(json.find("a")->place), std::pair(2, 9));
  const Json& inner = json.find("a")->array()[1];
  EXPECT_EQ(at(inner.place), std::pair(3, 4));
  EXPECT_EQ(at(inner.find("b")->key_place), std::pair(3, 5));
  EXPECT_EQ(at(inner.find("b")->place), std::pair(3, 10));
  EXPECT_EQ(inner.find("b")->spelling(), "-2.50e1");
  EXPECT_EQ(at(json.find("é")->key_place), std::pair(4, 1));
  EXPECT_EQ(at(json.find("é")->place), std::pair(4, 6));
}

// Whatever the bytes, parse_json and nlohmann's own parser agree on what is JSON, and it never does worse
// than refuse.
TEST_F(Reading, AgreesWithTheLibraryOnDamagedTexts) {
  std::mt19937 random(7);
  const std::string whole = toys::example;
  const std::string damage = "{}[]\",:\\0123456789.eE-+ \n\xC3\x80truefalsn";
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = i % 2 ? whole : R"([1, -2.5e3, "a\u00e9\"\\", {"k": [true, null]}, "é"])";
    for (int changes = 0; changes <= i % 3; ++changes) {
      const std::size_t at = random() % text.size();
      if (random() % 2)
        text[at] = damage[random() % damage.size()];
      else
        text.erase(at, 1 + random() % 3);
    }
    Diagnostics problems;
    const Json json = parse_json(text, "", problems);
    const bool accepted = nlohmann::json::accept(text);
    const bool only_duplicates = std::all_of(problems.begin(), problems.end(), [](const Diagnostic& problem) {
      return problem.code == "duplicate-key";
    });
    ASSERT_EQ(only_duplicates, accepted) << text << "\n" << toys::all_text(problems);
    if (accepted && problems.empty()) {
      Diagnostics none;
      ASSERT_EQ(parse_json(compact(json, true), "", none), json) << text;
      ASSERT_EQ(nlohmann::json::parse(compact(json, true)), nlohmann::json::parse(text)) << text;
    }
    refused += !accepted;
    if (!accepted) {
      ASSERT_GT(problems.front().place.line, 0) << text;
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST_F(Reading, TypesFlowThroughDotsAndSwitches) {
  const Document document = toys::document_of(
      toys::with_nodes(R"("a": {"type": "Load"}, "d": {"type": "Dot", "inputs": {"input": "a.points"}},
        "w": {"type": "Switch", "inputs": {"inputs": ["d.output"]}}, "e": {"type": "Dot"})"),
      registry_);
  EXPECT_EQ(type_of_output(document, registry_, {"w", "output", {}}), "Points");
  EXPECT_EQ(type_of_output(document, registry_, {"a", "motion", {}}), "Motion");
  EXPECT_EQ(type_of_output(document, registry_, {"e", "output", {}}), std::nullopt);
}

TEST_F(Reading, CyclesAreFoundOnceEach) {
  const Document document = toys::document_of(
      toys::with_nodes(
          R"("a": {"type": "Dot", "inputs": {"input": "c.output"}}, "b": {"type": "Dot", "inputs": {"input": "a.output"}},
        "c": {"type": "Dot", "inputs": {"input": "b.output"}}, "d": {"type": "Dot", "inputs": {"input": "a.output"}},
        "e": {"type": "Dot", "inputs": {"input": "e.output"}})"),
      registry_);
  EXPECT_EQ(cycles(document), (std::vector<std::vector<std::string>>{{"a", "b", "c"}, {"e"}}));
}

TEST_F(Reading, EveryUnitCanBeTakenOutAndPutBack) {
  const ReadResult result = read_document(toys::example, "g", registry_);
  const std::vector<Unit> units = {
      {Unit::Kind::node, "walk", {}},
      {Unit::Kind::node_param, "out", "file"},
      {Unit::Kind::node_input, "transfer", "style"},
      {Unit::Kind::publish_param, "source", {}},
      {Unit::Kind::publish_output, "result", {}},
      {Unit::Kind::ui_node, "walk", {}},
  };
  for (const Unit& unit : units) {
    Document document = result.document;
    const auto value = get(document, unit);
    ASSERT_TRUE(value) << to_text(unit);
    set(document, unit, std::nullopt);
    EXPECT_FALSE(get(document, unit)) << to_text(unit);
    EXPECT_NE(write_document(document, registry_), toys::example);
    set(document, unit, value);
    EXPECT_EQ(write_document(document, registry_), toys::example) << to_text(unit);
  }
}

TEST(NodeName, IsLettersDigitsUnderscoreAndDash) {
  EXPECT_TRUE(is_node_name("a"));
  EXPECT_TRUE(is_node_name("_walk-2_B"));
  EXPECT_TRUE(is_node_name(std::string(64, 'a')));
  for (const std::string bad : {"", "2a", "-a", "a b", "a.b", "a/b", "é", "${a}"})
    EXPECT_FALSE(is_node_name(bad)) << bad;
  EXPECT_FALSE(is_node_name(std::string(65, 'a')));
}

}  // namespace
}  // namespace kinegraph
