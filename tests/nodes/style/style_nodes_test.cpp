// QuatStats and StyleTransfer as nodes.
#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/gait/gait.h"
#include "nodes/motion/motion.h"
#include "nodes/style/stats.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/style/small_motion.h"

namespace kinegraph {
namespace {

NodeType type_of(const char* name) {
  return *all_nodes().find(name);
}

Motion nodding(double amplitude, double speed) {
  SmallMotion motion;
  motion.place = [speed](double s) { return Vec3{0, 1, speed * s}; };
  motion.head = [amplitude](double s) { return axis_angle({1, 0, 0}, amplitude * std::sin(6 * s)); };
  return motion.made(240);
}

Stats stats(const Motion& motion, const char* space = "quaternion") {
  NodeInMemory node(type_of("QuatStats"));
  return node.link("motion", motion).set("space", space).run().out<Stats>("stats");
}

TEST(StyleNodes, HaveTheNamesThatFilesDependOn) {
  const NodeType measure = type_of("QuatStats");
  for (const char* name : {"mean", "space", "joints", "range"}) EXPECT_TRUE(measure.find_param(name)) << name;
  EXPECT_EQ(measure.find_param("mean")->choices.front().key, "karcher");
  EXPECT_EQ(measure.find_param("space")->choices.front().key, "quaternion");

  const NodeType transfer = type_of("StyleTransfer");
  EXPECT_EQ(transfer.inputs[0].name, "motion");
  EXPECT_EQ(transfer.inputs[1].name, "style");
  EXPECT_TRUE(transfer.find_input("own")->optional);
  EXPECT_EQ(transfer.outputs[0].passes, "motion");
  for (const auto& [name, first] : {std::pair{"space", "quaternion"},
                                    {"transfer", "both"},
                                    {"root", "both"},
                                    {"travel", "feet"},
                                    {"heading", "keep"}}) {
    ASSERT_TRUE(transfer.find_param(name)) << name;
    EXPECT_EQ(transfer.find_param(name)->choices.front().key, first);
  }
  for (const char* name : {"max_gain", "joints", "range", "fade", "amount", "map"}) {
    EXPECT_TRUE(transfer.find_param(name)) << name;
  }
}

TEST(StyleNodes, RunTogether) {
  const Motion gentle = nodding(0.1, 1);
  const Stats style = stats(nodding(0.3, 1));
  NodeInMemory node(type_of("StyleTransfer"));
  const Motion result = node.link("motion", gentle).link("style", style).run().out<Motion>("motion");
  EXPECT_NEAR(stats(result).joints[2].spread, style.joints[2].spread, 1e-9);
}

TEST(StyleNodes, PassEveryParameterOn) {
  const Motion gentle = nodding(0.05, 1);
  const Stats style = stats(nodding(0.5, 2));
  const auto spread = [&](const char* param, Json value) {
    NodeInMemory node(type_of("StyleTransfer"));
    return stats(node.link("motion", gentle)
                     .link("style", style)
                     .set(param, std::move(value))
                     .run()
                     .out<Motion>("motion"));
  };
  const double own = stats(gentle).joints[2].spread;
  EXPECT_NEAR(spread("max_gain", 2.0).joints[2].spread, 2 * own, 1e-9);
  EXPECT_NEAR(spread("max_gain", 0.0).joints[2].spread, style.joints[2].spread, 1e-9);
  EXPECT_NEAR(spread("transfer", "mean").joints[2].spread, own, 1e-9);
  EXPECT_NEAR(spread("joints", "-Head").joints[2].spread, own, 1e-12);
  EXPECT_NEAR(spread("amount", 0.0).joints[2].spread, own, 1e-12);
  EXPECT_NEAR(spread("map", Json(Json::Array{"Spine=Spine"})).joints[2].spread, own, 1e-12);
  EXPECT_NEAR(spread("travel", "printed").root_mean[1], 2, 1e-6);
  EXPECT_NEAR(spread("root", "none").root_mean[1], 1, 1e-9);
  EXPECT_LT(spread("range", Json(Json::Array{0, 120})).joints[2].spread, 4 * own);
}

TEST(StyleNodes, RefuseWhatTheyCannotDo) {
  const Motion motion = nodding(0.1, 1);
  NodeInMemory euler(type_of("StyleTransfer"));
  EXPECT_EQ(euler.link("motion", motion).link("style", stats(motion)).set("space", "euler").refusal().code,
            "space-mismatch");
  NodeInMemory unknown(type_of("QuatStats"));
  const Diagnostic problem = unknown.link("motion", motion).set("joints", "Haed").refusal();
  EXPECT_EQ(problem.code, "unknown-joint");
  NodeInMemory beyond(type_of("QuatStats"));
  EXPECT_EQ(beyond.link("motion", motion).set("range", Json(Json::Array{500, nullptr})).refusal().code,
            "bad-range");
}

}  // namespace
}  // namespace kinegraph
