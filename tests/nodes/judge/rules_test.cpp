#include "nodes/judge/rules.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"

namespace kinegraph {
namespace {

Metrics numbers(std::vector<Metric> all) {
  Metrics metrics;
  metrics.all = std::move(all);
  return metrics;
}

bool passes(const char* text, const Metrics& metrics, const Metrics* baseline = nullptr) {
  return evaluate(parse_rule(text), metrics, baseline).passed;
}

TEST(ParseRule, ReadsNameRelationAndNumber) {
  const Rule rule = parse_rule("jerk.LeftFoot-2 <= -1.5e2");
  EXPECT_EQ(rule.name, "jerk.LeftFoot-2");
  EXPECT_EQ(rule.relation, Rule::Relation::at_most);
  EXPECT_EQ(rule.number, -150);
  EXPECT_EQ(rule.baseline, "");
  EXPECT_EQ(rule.text, "jerk.LeftFoot-2 <= -1.5e2");
}

TEST(ParseRule, ReadsAMultipleOfTheBaseline) {
  const Rule rule = parse_rule("skate < 1.05 * baseline.skate");
  EXPECT_EQ(rule.number, 1.05);
  EXPECT_EQ(rule.baseline, "skate");
  EXPECT_EQ(parse_rule("skate>baseline.skate.LeftFoot").number, 1);
  EXPECT_EQ(parse_rule("skate>baseline.skate.LeftFoot").baseline, "skate.LeftFoot");
}

TEST(ParseRule, NeedsNoSpaces) {
  EXPECT_EQ(parse_rule("skate<0.1").number, 0.1);
  EXPECT_EQ(parse_rule("  skate  >=2*baseline.skate  ").relation, Rule::Relation::at_least);
}

TEST(ParseRule, SaysWhatIsWrongAndWhere) {
  const std::vector<std::pair<const char*, const char*>> wrong = {
      {"", "expected the name of a metric at character 1"},
      {"< 1", "expected the name of a metric at character 1"},
      {"skate", "expected <, <=, > or >= at character 6"},
      {"skate = 1", "expected <, <=, > or >= at character 7"},
      {"skate == 1", "expected <, <=, > or >= at character 7"},
      {"skate <", "expected a number or baseline.NAME at character 8"},
      {"skate < low", "expected a number or baseline.NAME at character 9"},
      {"skate < nan", "expected a number or baseline.NAME at character 9"},
      {"skate < inf", "expected a number or baseline.NAME at character 9"},
      {"skate < 1e999", "expected a number or baseline.NAME at character 9"},
      {"skate < 1 m", "expected * or the end of the rule at character 11"},
      {"skate < 1.05 * skate", "expected baseline.NAME at character 16"},
      {"skate < 1.05 *", "expected baseline.NAME at character 15"},
      {"skate < baseline.", "expected the name of a metric at character 18"},
      {"skate < baseline.skate + 1", "expected the end of the rule at character 24"},
      {"left foot < 1", "expected <, <=, > or >= at character 6"},
  };
  for (const auto& [text, problem] : wrong) {
    try {
      parse_rule(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, "bad-rule");
      EXPECT_NE(failure.diagnostic().message.find(problem), std::string::npos)
          << text << ": " << failure.diagnostic().message;
      EXPECT_FALSE(failure.diagnostic().hint.empty());
    }
  }
}

TEST(EvaluateRule, KnowsTheFourRelations) {
  const Metrics m = numbers({{"a", 1.0, ""}});
  EXPECT_TRUE(passes("a < 1.5", m));
  EXPECT_FALSE(passes("a < 1", m));
  EXPECT_TRUE(passes("a <= 1", m));
  EXPECT_FALSE(passes("a <= 0.9", m));
  EXPECT_TRUE(passes("a > 0.5", m));
  EXPECT_FALSE(passes("a > 1", m));
  EXPECT_TRUE(passes("a >= 1", m));
  EXPECT_FALSE(passes("a >= 1.1", m));
}

TEST(EvaluateRule, MultipliesTheBaseline) {
  const Metrics m = numbers({{"a", 1.04, ""}});
  const Metrics base = numbers({{"a", 1.0, ""}});
  EXPECT_TRUE(passes("a < 1.05 * baseline.a", m, &base));
  EXPECT_FALSE(passes("a < 1.03 * baseline.a", m, &base));
  const RuleOutcome outcome = evaluate(parse_rule("a < 1.03 * baseline.a"), m, &base);
  EXPECT_EQ(outcome.value, 1.04);
  EXPECT_EQ(outcome.limit, 1.03);
}

TEST(EvaluateRule, FailsWhatCouldNotBeMeasured) {
  const Metrics m = numbers({{"a", 1.0, ""}, {"none", std::nullopt, ""}});
  const Metrics base = numbers({{"none", std::nullopt, ""}});
  for (const char* text : {"none < 1", "none > 1", "unknown < 1", "unknown > -1", "a < baseline.none",
                           "a > baseline.none", "a < baseline.unknown"}) {
    EXPECT_FALSE(passes(text, m, &base)) << text;
  }
  EXPECT_FALSE(passes("a < baseline.a", m, nullptr));
  EXPECT_FALSE(evaluate(parse_rule("unknown < 1"), m, nullptr).value);
  EXPECT_FALSE(evaluate(parse_rule("a < baseline.a"), m, nullptr).limit);
}

}  // namespace
}  // namespace kinegraph
