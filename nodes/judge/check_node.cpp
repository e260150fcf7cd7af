#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/judge/rules.h"
#include "nodes/motion/metrics.h"

namespace kinegraph {

namespace {

void check_rule_text(std::string_view text) {
  parse_rule(text);
}

}  // namespace

NodeType check_node() {
  NodeType type;
  type.name = "Check";
  type.category = "judge";
  type.help = "Holds metrics to rules; a rule that fails makes the run exit 4 and stands in the report.";
  type.keywords = {"rule", "assert", "test", "regression", "CI"};
  type.effect = Effect::checks;
  type.input("metrics", {"Metrics"}, "the numbers to judge");
  type.optional_input("baseline", {"Metrics"}, "what rules call baseline.NAME; open: those rules fail");
  type.param("rules", list(text("").checked_by(check_rule_text)),
             "NAME < NUMBER, or NAME < 1.05 * baseline.NAME; <, <=, > or >=. A number that is missing fails "
             "its rule");
  type.compute = [](Compute& compute) {
    const auto& metrics = compute.input<Metrics>("metrics");
    const Metrics* baseline = compute.optional_input<Metrics>("baseline");
    std::vector<Rule> rules;
    for (const std::string& text : compute.params().texts("rules")) rules.push_back(parse_rule(text));
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();
    for (const Rule& rule : rules) {
      const RuleOutcome outcome = evaluate(rule, metrics, baseline);
      for (Diagnostic& reason : reasons_unmeasured(rule, metrics, baseline))
        compute.work().report(std::move(reason));
      compute.rule(rule.text, outcome.value.value_or(missing), outcome.limit.value_or(missing),
                   outcome.passed);
    }
  };
  return type;
}

}  // namespace kinegraph
