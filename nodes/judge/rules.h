// Rules that a motion's numbers must keep: `skate < 0.02`, `jerk.LeftFoot <= 1.05 * baseline.jerk.LeftFoot`.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "graph/diagnostic.h"
#include "nodes/motion/metrics.h"

namespace kinegraph {

// NAME (<|<=|>|>=) NUMBER, or NAME (<|<=|>|>=) [NUMBER *] baseline.NAME. Spaces may stand between the parts.
struct Rule {
  enum class Relation { less, at_most, greater, at_least };
  std::string text;  // as written
  std::string name;  // [A-Za-z0-9_.-]+
  Relation relation = Relation::less;
  double number = 0;     // the limit, or the factor of the baseline's
  std::string baseline;  // name in the baseline; "" = number is the limit
};

// Throws Failure ("bad-rule") that says what was expected and where.
Rule parse_rule(std::string_view text);

struct RuleOutcome {
  std::optional<double> value;  // null or unknown: nothing
  std::optional<double> limit;
  bool passed = false;  // never where either is missing
};
// `baseline` may be null.
RuleOutcome evaluate(const Rule& rule, const Metrics& metrics, const Metrics* baseline);

// Why an outcome lacks its value or limit, of param "rules": a rule fails alike on a wrong name
// ("unknown-metric", with the nearest), on a number that could not be had ("not-measured") and without a
// baseline ("no-baseline"); a person wants to know which.
Diagnostics reasons_unmeasured(const Rule& rule, const Metrics& metrics, const Metrics* baseline);

}  // namespace kinegraph
