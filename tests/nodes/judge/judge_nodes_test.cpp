// Metrics and Check as nodes.
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/all_nodes.h"
#include "nodes/motion/metrics.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/style/small_motion.h"

namespace kinegraph {
namespace {

NodeType type_of(const char* name) {
  return *all_nodes().find(name);
}

// Keeps what Check tells.
class CheckInMemory : public NodeInMemory {
 public:
  struct Outcome {
    std::string rule;
    double value, limit;
    bool passed;
  };
  CheckInMemory() : NodeInMemory(type_of("Check")) {}
  void rule(std::string_view text, double value, double limit, bool passed) override {
    outcomes.push_back({std::string(text), value, limit, passed});
  }
  std::vector<Outcome> outcomes;
};

Metrics numbers(std::vector<Metric> all) {
  Metrics metrics;
  metrics.all = std::move(all);
  return metrics;
}

TEST(CheckNode, TellsEveryRulesOutcomeInOrder) {
  CheckInMemory check;
  check.link("metrics", numbers({{"skate", 0.2, "m/s"}, {"jerk", std::nullopt, ""}}))
      .link("baseline", numbers({{"skate", 0.1, "m/s"}}))
      .set("rules", Json(Json::Array{"skate < 0.5", "skate < 1.5 * baseline.skate", "jerk > 0"}))
      .run();
  ASSERT_EQ(check.outcomes.size(), 3u);
  EXPECT_TRUE(check.outcomes[0].passed);
  EXPECT_EQ(check.outcomes[0].value, 0.2);
  EXPECT_EQ(check.outcomes[0].limit, 0.5);
  EXPECT_FALSE(check.outcomes[1].passed);
  EXPECT_NEAR(check.outcomes[1].limit, 0.15, 1e-15);
  EXPECT_FALSE(check.outcomes[2].passed);
  EXPECT_TRUE(std::isnan(check.outcomes[2].value));
  EXPECT_EQ(check.outcomes[2].rule, "jerk > 0");
}

TEST(CheckNode, HasItsRulesCheckedBeforeAnythingRuns) {
  const NodeType type = type_of("Check");
  const Diagnostics problems =
      check(*type.find_param("rules"), Json(Json::Array{"skate < 1", "skate is low"}), "rules");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, "bad-rule");
  EXPECT_EQ(problems[0].param, "rules[1]");
}

TEST(MetricsNode, MeasuresTheJointsAndRangeAskedFor) {
  SmallMotion moving;
  moving.place = [](double s) { return Vec3{s < 0.5 ? 0 : std::sin(30 * s), 1, 0}; };
  NodeInMemory node(type_of("Metrics"));
  const Metrics early = node.link("motion", moving.made(120))
                            .set("joints", "Hips")
                            .set("range", Json(Json::Array{0, 40}))
                            .run()
                            .out<Metrics>("metrics");
  EXPECT_TRUE(early.find("jerk.Hips"));
  EXPECT_FALSE(early.find("jerk.Head"));
  EXPECT_NEAR(*early.find("jerk")->value, 0, 1e-6);
  EXPECT_FALSE(early.find("style_distance")->value);
}

TEST(MetricsNode, HasTheNamesThatFilesDependOn) {
  const NodeType type = type_of("Metrics");
  EXPECT_FALSE(type.find_input("motion")->optional);
  EXPECT_TRUE(type.find_input("reference")->optional);
  EXPECT_TRUE(type.find_input("contacts")->optional);
  for (const char* name : {"joints", "range", "map"}) EXPECT_TRUE(type.find_param(name)) << name;
  const NodeType check = type_of("Check");
  EXPECT_TRUE(check.find_input("baseline")->optional);
  EXPECT_TRUE(check.outputs.empty());
  EXPECT_TRUE(check.effect == Effect::checks);
}

}  // namespace
}  // namespace kinegraph
