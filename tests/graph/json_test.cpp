#include "graph/json.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <random>

namespace kinegraph {
namespace {

TEST(ShortestNumber, WritesPeoplesNumbersAsPeopleDo) {
  EXPECT_EQ(shortest_number(0), "0");
  EXPECT_EQ(shortest_number(-0.0), "0");
  EXPECT_EQ(shortest_number(1), "1");
  EXPECT_EQ(shortest_number(-12.5), "-12.5");
  EXPECT_EQ(shortest_number(0.1), "0.1");
  EXPECT_EQ(shortest_number(0.001), "0.001");
  EXPECT_EQ(shortest_number(100000), "100000");
  EXPECT_EQ(shortest_number(9007199254740991), "9007199254740991");
  EXPECT_EQ(shortest_number(1.0 / 3), "0.3333333333333333");
}

TEST(ShortestNumber, ChangesToExponentsWhereEcmaScriptDoes) {
  EXPECT_EQ(shortest_number(1e20), "100000000000000000000");
  EXPECT_EQ(shortest_number(1e21), "1e+21");
  EXPECT_EQ(shortest_number(1.5e300), "1.5e+300");
  EXPECT_EQ(shortest_number(0.000001), "0.000001");
  EXPECT_EQ(shortest_number(0.0000001), "1e-7");
  EXPECT_EQ(shortest_number(5e-324), "5e-324");
  EXPECT_EQ(shortest_number(-1.7976931348623157e308), "-1.7976931348623157e+308");
}

TEST(ShortestNumber, ReadsBackTheSame) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const std::string text = shortest_number(value);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(back, value) << text;
  }
}

TEST(ShortestNumber, RefusesWhatJsonCannotHold) {
  EXPECT_THROW(shortest_number(NAN), std::logic_error);
}

TEST(InQuotes, EscapesOnlyWhatJsonAsksFor) {
  EXPECT_EQ(in_quotes("a/b é \"c\" \\ \n\t\x01"), "\"a/b é \\\"c\\\" \\\\ \\n\\t\\u0001\"");
}

TEST(Json, IsEqualByMeaning) {
  EXPECT_EQ(Json::number_as_read(1, "1.0"), Json(1));
  EXPECT_EQ(Json(-0.0), Json(0));
  EXPECT_FALSE(Json("1") == Json(1));
  EXPECT_FALSE(Json(false) == Json());
}

TEST(Json, SaysWhenItIsAskedForAnotherKind) {
  EXPECT_THROW(Json("x").number(), std::logic_error);
  EXPECT_THROW(Json(1).array(), std::logic_error);
  EXPECT_EQ(Json(1).find("x"), nullptr);
}

TEST(Compact, KeepsSpellingsOnlyWhenAsked) {
  const Json value(
      Json::Object{{"b", Json::Array{Json::number_as_read(1, "1.00"), true, nullptr}}, {"a", "x"}});
  EXPECT_EQ(compact(value), R"({"a": "x", "b": [1, true, null]})");
  EXPECT_EQ(compact(value, true), R"({"a": "x", "b": [1.00, true, null]})");
}

TEST(Indented, PutsEveryMemberOnItsLine) {
  const Json value(Json::Object{{"a", Json::Array{1, Json::Object{}}}, {"b", Json::Array{}}});
  EXPECT_EQ(indented(value), "{\n  \"a\": [\n    1,\n    {}\n  ],\n  \"b\": []\n}\n");
}

}  // namespace
}  // namespace kinegraph
