#include "nodes/judge/rules.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstddef>

#include "graph/diagnostic.h"

namespace kinegraph {

namespace {

constexpr std::string_view baseline_prefix = "baseline.";

bool in_name(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '-';
}

class RuleReader {
 public:
  explicit RuleReader(std::string_view text) : text_(text) {}

  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool take(std::string_view token) {
    skip_spaces();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  bool starts(std::string_view token) {
    skip_spaces();
    return text_.substr(at_, token.size()) == token;
  }
  std::string name(const char* expected) {
    skip_spaces();
    const std::size_t start = at_;
    while (at_ < text_.size() && in_name(text_[at_])) ++at_;
    if (at_ == start) fail(expected);
    return std::string(text_.substr(start, at_ - start));
  }
  double number(const char* expected) {
    skip_spaces();
    double value = 0;
    const char* first = text_.data() + at_;
    const auto [last, problem] = std::from_chars(first, text_.data() + text_.size(), value);
    if (problem != std::errc{} || !std::isfinite(value)) fail(expected);
    at_ += static_cast<std::size_t>(last - first);
    return value;
  }
  void end(const char* expected) {
    skip_spaces();
    if (at_ < text_.size()) fail(expected);
  }
  [[noreturn]] void fail(const char* expected) const {
    throw Failure(
        error("bad-rule", fmt::format("rule \"{}\": expected {} at character {}", text_, expected, at_ + 1))
            .hinting("write NAME < NUMBER, or NAME < 1.05 * baseline.NAME; <, <=, > and >= are known"));
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

Rule::Relation relation(RuleReader& in) {
  if (in.take("<=")) return Rule::Relation::at_most;
  if (in.take("<")) return Rule::Relation::less;
  if (in.take(">=")) return Rule::Relation::at_least;
  if (in.take(">")) return Rule::Relation::greater;
  in.fail("<, <=, > or >=");
}

std::optional<double> value_of(const Metrics* metrics, std::string_view name) {
  const Metric* metric = metrics ? metrics->find(name) : nullptr;
  if (!metric || !metric->value || !std::isfinite(*metric->value)) return std::nullopt;
  return metric->value;
}

}  // namespace

Rule parse_rule(std::string_view text) {
  RuleReader in(text);
  Rule rule;
  rule.text = std::string(text);
  rule.name = in.name("the name of a metric");
  rule.relation = relation(in);
  rule.number = 1;
  bool wants_baseline = in.starts(baseline_prefix);
  if (!wants_baseline) {
    rule.number = in.number("a number or baseline.NAME");
    wants_baseline = in.take("*");
  }
  if (wants_baseline) {
    if (!in.take(baseline_prefix)) in.fail("baseline.NAME");
    rule.baseline = in.name("the name of a metric");
  }
  in.end(wants_baseline ? "the end of the rule" : "* or the end of the rule");
  return rule;
}

RuleOutcome evaluate(const Rule& rule, const Metrics& metrics, const Metrics* baseline) {
  RuleOutcome out;
  out.value = value_of(&metrics, rule.name);
  out.limit = rule.number;
  if (!rule.baseline.empty()) {
    const std::optional<double> base = value_of(baseline, rule.baseline);
    out.limit = base ? std::optional<double>(rule.number * *base) : std::nullopt;
  }
  if (!out.value || !out.limit) return out;
  const double value = *out.value;
  const double limit = *out.limit;
  switch (rule.relation) {
    case Rule::Relation::less:
      out.passed = value < limit;
      break;
    case Rule::Relation::at_most:
      out.passed = value <= limit;
      break;
    case Rule::Relation::greater:
      out.passed = value > limit;
      break;
    case Rule::Relation::at_least:
      out.passed = value >= limit;
      break;
  }
  return out;
}

Diagnostics reasons_unmeasured(const Rule& rule, const Metrics& metrics, const Metrics* baseline) {
  Diagnostics reasons;
  const auto look = [&](const std::string& name, const char* of, const Metrics* in) {
    if (value_of(in, name)) return;
    Diagnostic reason;
    if (!in) {
      reason = warning("no-baseline", fmt::format("rule \"{}\" needs a baseline", rule.text))
                   .hinting("link baseline");
    } else if (in->find(name)) {
      reason = warning("not-measured",
                       fmt::format("rule \"{}\" fails: {}{} could not be measured", rule.text, of, name))
                   .hinting("it needs something that is not there, such as a reference or plants");
    } else {
      std::vector<std::string> names;
      for (const Metric& metric : in->all) names.push_back(metric.name);
      reason = warning("unknown-metric",
                       fmt::format("rule \"{}\" fails: there is no metric {}{}", rule.text, of, name))
                   .hinting(suggestion(name, names));
    }
    reason.param = "rules";
    reasons.push_back(std::move(reason));
  };
  look(rule.name, "", &metrics);
  if (!rule.baseline.empty()) look(rule.baseline, "baseline.", baseline);
  return reasons;
}

}  // namespace kinegraph
