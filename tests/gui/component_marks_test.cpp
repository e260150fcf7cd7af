#include "gui/components/component_marks.h"

#include <gtest/gtest.h>

#include "graph/json.h"

namespace kinegraph {
namespace {

TEST(EditorComponents, EveryComponentThatAnEditTouchesIsMarked) {
  const auto edit = [](const char* op, Json::Object rest) {
    rest["op"] = Json(op);
    return Json(std::move(rest));
  };
  const auto term = [](int component) { return Json(Json::Array{Json(component), Json(1)}); };
  const Json edits(Json::Array{
      edit("merge", {{"name", Json("swing")}, {"terms", Json(Json::Array{term(1), term(2)})}}),
      edit("scale", {{"component", Json("swing")}, {"factor", Json(1.3)}}),
      edit("scale", {{"component", Json(2)}, {"factor", Json(0)}}),
      edit("translate", {{"component", Json("u4")}, {"value", Json(-0.5)}}),
      edit("substitute", {{"component", Json(3)}}),
      edit("transfer", {{"components", Json(Json::Array{Json(5)})}, {"from", Json(0)}, {"to", Json(1)}})});
  EXPECT_EQ(mark_of(edits, 1), "→ swing");
  EXPECT_EQ(mark_of(edits, 2), "× 0  → swing");
  EXPECT_EQ(mark_of(edits, 3), "replaced");
  EXPECT_EQ(mark_of(edits, 4), "− 0.5");
  EXPECT_EQ(mark_of(edits, 5), "0 → 1");
  EXPECT_EQ(mark_of(edits, 6), "");
}

}  // namespace
}  // namespace kinegraph
