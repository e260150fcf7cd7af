#include "graph/param.h"

#include <gtest/gtest.h>

#include "graph/file/parse_json.h"

namespace kinegraph {
namespace {

Json json(std::string_view text) {
  Diagnostics problems;
  Json value = parse_json(text, "", problems);
  EXPECT_TRUE(problems.empty()) << text;
  return value;
}
// "code param" of each problem.
std::vector<std::string> problems(const ParamType& type, std::string_view text) {
  std::vector<std::string> all;
  for (const Diagnostic& problem : check(type, json(text), "p"))
    all.push_back(problem.code + " " + problem.param);
  return all;
}
using Codes = std::vector<std::string>;

ParamType edits() {
  return list(object({
      required(choice({{"scale", ""}, {"translate", ""}}).as("op", "what")),
      required(integer(1).between(1, 99).as("component", "which")),
      number(1).between(0, 10).as("factor", "how much"),
      range().as("frames", "when").optional(),
  }));
}

TEST(Check, HoldsEveryKindToItsForm) {
  EXPECT_EQ(problems(number(0), "1.5"), Codes{});
  EXPECT_EQ(problems(number(0), "\"1\""), Codes{"wrong-type p"});
  EXPECT_EQ(problems(number(0).between(0, 1), "1.01"), Codes{"out-of-range p"});
  EXPECT_EQ(problems(integer(0), "2"), Codes{});
  EXPECT_EQ(problems(integer(0), "2.0"), Codes{});
  EXPECT_EQ(problems(integer(0), "2.5"), Codes{"not-an-integer p"});
  EXPECT_EQ(problems(integer(0), "9007199254740991"), Codes{});
  EXPECT_EQ(problems(integer(0), "9007199254740993"), Codes{"out-of-range p"});
  EXPECT_EQ(problems(boolean(false), "1"), Codes{"wrong-type p"});
  EXPECT_EQ(problems(choice({{"a", ""}, {"b", ""}}), "\"b\""), Codes{});
  EXPECT_EQ(problems(choice({{"a", ""}, {"b", ""}}), "\"c\""), Codes{"bad-choice p"});
  EXPECT_EQ(problems(range(), "[0, null]"), Codes{});
  EXPECT_EQ(problems(range(), "[3, 4]"), Codes{});
  EXPECT_EQ(problems(range(), "[4, 4]"), Codes{"bad-range p"});
  EXPECT_EQ(problems(range(), "[-1, 4]"), Codes{"bad-range p"});
  EXPECT_EQ(problems(range(), "[0.5, 4]"), Codes{"bad-range p"});
  EXPECT_EQ(problems(range(), "[1]"), Codes{"wrong-type p"});
  EXPECT_EQ(problems(unit_of({{"m", ""}, {"cm", ""}}), "\"cm\""), Codes{});
  EXPECT_EQ(problems(unit_of({{"m", ""}, {"cm", ""}}), "0.0254"), Codes{});
  EXPECT_EQ(problems(unit_of({{"m", ""}, {"cm", ""}}), "0"), Codes{"out-of-range p"});
  EXPECT_EQ(problems(tuple({number(0), integer(0)}), "[1, 2.5]"), Codes{"not-an-integer p[1]"});
  EXPECT_EQ(problems(tuple({number(0), integer(0)}), "[1]"), Codes{"wrong-length p"});
  EXPECT_EQ(problems(table(number(1)), R"({"*Leg*": 1, "Head": "x"})"), Codes{"wrong-type p.Head"});
}

TEST(Check, NamesEveryProblemOfAListOfObjectsWhereItStands) {
  EXPECT_EQ(
      problems(edits(),
               R"([{"op": "scale", "component": 1}, {"op": "translate", "component": 2, "frames": null}])"),
      Codes{});
  EXPECT_EQ(problems(edits(), R"([{"op": "scale", "component": 0, "fator": 2}, {"factor": 11}, 3])"),
            (Codes{"out-of-range p[0].component", "unknown-key p[0]", "out-of-range p[1].factor",
                   "missing-key p[1]", "missing-key p[1]", "wrong-type p[2]"}));
  const auto all = check(edits(), json("[{\"op\": \"scale\",\n  \"component\": 1, \"fator\": 2}]"), "p");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].hint, "did you mean \"factor\"?");
  EXPECT_EQ(all[0].place.line, 2);
  EXPECT_EQ(all[0].place.column, 19);
}

TEST(Check, ComplainsOfTheAlternativeThatFitsBest) {
  const ParamType one_or_list = either({integer(1).between(1, 9), list(integer(1).between(1, 9))});
  EXPECT_EQ(problems(one_or_list, "3"), Codes{});
  EXPECT_EQ(problems(one_or_list, "[1, 2]"), Codes{});
  EXPECT_EQ(problems(one_or_list, "[1, 12]"), Codes{"out-of-range p[1]"});
  EXPECT_EQ(problems(one_or_list, "true"), Codes{"wrong-type p"});
}

TEST(Check, TellsAllThatAnObjectToldApartByAChoiceCouldBe) {
  const auto op = [](const char* name) { return required(choice({{name, name}})).as("op", "what to do"); };
  const ParamType edit = either({object({op("scale"), number(1).as("factor", "by how much")}),
                                 object({op("replace"), text("").as("by", "by what")})});
  EXPECT_EQ(problems(edit, R"({"op": "scale", "factor": 2})"), Codes{});
  EXPECT_EQ(problems(edit, R"({"op": "replace", "by": 2})"), Codes{"wrong-type p.by"});
  const auto told = [&](const char* text) { return check(edit, json(text), "p"); };
  ASSERT_EQ(told(R"({"op": "explode"})").size(), 1u) << "and not what another alternative lacks";
  EXPECT_EQ(told(R"({"op": "explode"})")[0].hint, "there is scale, replace");
  EXPECT_EQ(told(R"({"op": "replaced"})")[0].hint, "did you mean \"replace\"?");
  EXPECT_EQ(problems(edit, R"({"factor": 2})"), Codes{"missing-key p"});
  EXPECT_EQ(told(R"({"factor": 2})")[0].hint, "one of scale, replace");
  EXPECT_EQ(problems(edit, R"({"op": 5})"), Codes{"wrong-type p.op"});
  EXPECT_EQ(told(R"({"op": 5})")[0].hint, "wanted is one of scale, replace");
}

TEST(Check, AsksATextsOwnGrammar) {
  auto grammar = [](std::string_view rule) {
    if (rule.find('<') == std::string_view::npos) throw Failure(error("bad-rule", "expected <"));
  };
  const ParamType rules = list(text("").checked_by(grammar));
  EXPECT_EQ(problems(rules, R"(["a < 1", "a = 1"])"), Codes{"bad-rule p[1]"});
  EXPECT_EQ(problems(rules, "[1]"), Codes{"wrong-type p[0]"});
}

TEST(Completed, MakesEqualMeaningEqual) {
  EXPECT_EQ(compact(completed(edits(), json(R"([{"op": "scale", "component": 2.0}])")), true),
            R"([{"component": 2, "factor": 1, "frames": null, "op": "scale"}])");
  EXPECT_EQ(compact(completed(number(0), json("-0.0")), true), "0");
  EXPECT_EQ(compact(completed(number(0), json("1e0")), true), "1");
}

TEST(ParseValue, TakesJsonOrBareText) {
  EXPECT_EQ(parse_value(number(0), "1.5"), Json(1.5));
  EXPECT_EQ(parse_value(text(""), "a b"), Json("a b"));
  EXPECT_EQ(parse_value(text(""), "\"a b\""), Json("a b"));
  EXPECT_EQ(parse_value(text(""), "12"), Json("12"));
  EXPECT_EQ(parse_value(open_file(), "clips/a.bvh"), Json("clips/a.bvh"));
  EXPECT_EQ(parse_value(choice({{"a", ""}}), "a"), Json("a"));
  EXPECT_EQ(parse_value(unit_of({{"m", ""}}), "0.01"), Json(0.01));
  EXPECT_EQ(parse_value(unit_of({{"m", ""}}), "m"), Json("m"));
  EXPECT_EQ(parse_value(range(), "10:200"), Json(Json::Array{10, 200}));
  EXPECT_THROW(parse_value(range(), std::string(400, '9') + ":5"), Failure);
  EXPECT_EQ(parse_value(range(), "10:"), Json(Json::Array{10, nullptr}));
  EXPECT_EQ(parse_value(range(), "[1, 2]"), Json(Json::Array{1, 2}));
  EXPECT_EQ(parse_value(list(number(0)), "[1, 2]"), Json(Json::Array{1, 2}));
  EXPECT_EQ(parse_value(either({integer(1), text("")}), "x"), Json("x"));
  EXPECT_THROW(parse_value(number(0), "fast"), Failure);
  EXPECT_THROW(parse_value(boolean(false), "yes"), Failure);
}

TEST(Params, GivesTypedValues) {
  const Params params(
      json(R"({"a": 1.5, "n": 3, "on": true, "t": "x", "r": [2, null], "l": ["p", "q"]})").object());
  EXPECT_EQ(params.number("a"), 1.5);
  EXPECT_EQ(params.integer("n"), 3);
  EXPECT_TRUE(params.boolean("on"));
  EXPECT_EQ(params.text("t"), "x");
  EXPECT_EQ(params.range("r"), (FrameRange{2, {}}));
  EXPECT_EQ(params.texts("l"), (std::vector<std::string>{"p", "q"}));
  EXPECT_THROW(params.number("b"), std::logic_error);
  EXPECT_THROW(params.integer("a"), std::logic_error);
  EXPECT_THROW(params.text("a"), std::logic_error);
}

}  // namespace
}  // namespace kinegraph
