#include "graph/key.h"

#include <gtest/gtest.h>

#include <set>

namespace kinegraph {
namespace {

Key key_of(const Json& value) {
  KeyMaker maker;
  maker.add("value", value);
  return maker.finish();
}

TEST(Key, IsWrittenAs32HexadecimalDigitsAndReadBack) {
  const Key key{0x0123456789abcdef, 0xf};
  EXPECT_EQ(to_text(key), "0123456789abcdef000000000000000f");
  EXPECT_EQ(key_from_text(to_text(key)), key);
  EXPECT_FALSE(key_from_text("0123"));
  EXPECT_FALSE(key_from_text("0123456789ABCDEF000000000000000F"));
}

TEST(Key, OfAFileIsTheSameReadWholeOrInPieces) {
  const std::string text(100'000, 'x');
  Digester pieces;
  for (std::size_t at = 0; at < text.size(); at += 777) pieces.add(std::string_view(text).substr(at, 777));
  EXPECT_EQ(pieces.finish(), digest(text));
}

// The value is a promise to every cache on disk: it changes only together with the format version.
TEST(Key, StaysTheSameFromBuildToBuild) {
  EXPECT_EQ(to_text(digest("kinegraph")), to_text(digest(std::string("kine") + "graph")));
  EXPECT_EQ(to_text(digest("")), "99aa06d3014798d86001c324468d497f");
}

TEST(Key, TellsPartsFromTheirConcatenation) {
  std::set<Key> keys;
  for (auto [a, b] : {std::pair{"ab", "c"}, {"a", "bc"}, {"abc", ""}, {"", "abc"}}) {
    KeyMaker maker;
    maker.add("x", a);
    maker.add("x", b);
    keys.insert(maker.finish());
  }
  KeyMaker one;
  one.add("x", "abc");
  keys.insert(one.finish());
  EXPECT_EQ(keys.size(), 5u);
}

TEST(Key, TellsKindsOfParametersApart) {
  std::set<Key> keys;
  const std::vector<Json> values = {Json(nullptr),
                                    Json(false),
                                    Json(0),
                                    Json("0"),
                                    Json(""),
                                    Json(Json::Array{}),
                                    Json(Json::Object{}),
                                    Json(Json::Array{0}),
                                    Json(Json::Array(1, Json(Json::Array{0})))};
  for (const auto& value : values) keys.insert(key_of(value));
  EXPECT_EQ(keys.size(), values.size());
}

TEST(Key, TakesNumbersByValue) {
  EXPECT_EQ(key_of(Json(-0.0)), key_of(Json(0.0)));
  EXPECT_EQ(key_of(Json::number_as_read(1, "1.0e0")), key_of(Json(1)));
  EXPECT_NE(key_of(Json(0.1)), key_of(Json(0.1 + 1e-17 + 1e-16)));
}

TEST(Key, IgnoresWhereAValueStoodInItsFile) {
  Json here("walk"), there("walk");
  there.place = {7, 3};
  EXPECT_EQ(key_of(here), key_of(there));
}

}  // namespace
}  // namespace kinegraph
