#include "nodes/judge/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/loaded_file.h"
#include "nodes/judge/rules.h"
#include "nodes/node_params.h"

namespace kinegraph {

namespace {

struct Measured {
  std::shared_ptr<const Motion> motion;
  std::shared_ptr<const Metrics>
      metrics;  // of a metrics file, or measured of the motion where that can be done
};

Measured measured(const Program& program, const std::string& file, bool needs_metrics) {
  RunArguments arguments;
  Opened opened = graph_of_file(file);
  if (needs_metrics && program.registry.find("Metrics")) {
    Node node;
    node.type = "Metrics";
    node.inputs["motion"].links = {{"load", "motion", {}}};
    opened.document.nodes["metrics"] = std::move(node);
  }
  Session session(program, arguments, std::move(opened));
  if (!session.valid()) throw Failure(session.problems().front());
  Measured result;
  auto loaded = load_file(session, program, "");
  result.motion = std::dynamic_pointer_cast<const Motion>(loaded.value);
  result.metrics = std::dynamic_pointer_cast<const Metrics>(loaded.value);
  if (!result.motion && !result.metrics)
    throw Failure(error("not-comparable", fmt::format("a file of {} can't be compared", loaded.value->type()))
                      .in_file(file));
  if (result.motion && needs_metrics) {
    Progress silent(Progress::Form::none, program.terminal);
    session.run({{"metrics", "metrics"}}, silent, nullptr);
    result.metrics = std::dynamic_pointer_cast<const Metrics>(
        session.evaluator().value(session.plan(), "metrics", "metrics"));
  }
  return result;
}

// Frame t against frame t means nothing where they are at different times.
void check_rates(const Motion& a, const Motion& b, const CompareArguments& arguments) {
  try {
    check_same_rate(a.fps(), b.fps(), arguments.a, arguments.b);
  } catch (const Failure& failure) {
    const bool a_is_faster = a.fps() > b.fps();
    Diagnostic problem = failure.diagnostic();
    problem.port.clear();
    problem.hint = fmt::format(
        "motions are compared frame by frame; resample one first: kinegraph convert {} OUT --fps {:g}",
        a_is_faster ? arguments.a : arguments.b, a_is_faster ? b.fps() : a.fps());
    throw Failure(problem);
  }
}

Json value_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "-";
}

void tell_motions(const Terminal& terminal, const Comparison& c) {
  if (c.identical)
    return terminal.result("identical: every position and rotation is equal to the last bit\n");
  terminal.result(fmt::format("frames     {} and {}, {} compared\nrate       {:g} and {:g} fps\n", c.frames_a,
                              c.frames_b, c.compared, c.fps_a, c.fps_b));
  auto names = [&](const char* what, const std::vector<std::string>& list) {
    if (list.empty()) return;
    std::string all;
    for (const auto& name : list) all += (all.empty() ? "" : ", ") + name;
    terminal.result(fmt::format("{} {}\n", what, all));
  };
  names("only in A ", c.only_a);
  names("only in B ", c.only_b);
  if (c.compared == 0 || c.joints.empty()) return;
  terminal.result(
      fmt::format("positions  {:.6g} m apart on the mean, {:.6g} m at most\n"
                  "rotations  {:.6g}° apart on the mean, {:.6g}° at most\n\n",
                  c.position_mean, c.position_max, c.rotation_mean, c.rotation_max));
  auto joints = c.joints;
  std::stable_sort(joints.begin(), joints.end(),
                   [](const auto& a, const auto& b) { return a.position_max > b.position_max; });
  terminal.result(
      terminal.tinted(fmt::format("{:<24} {:>12} {:>12} {:>7} {:>12} {:>12} {:>7}\n", "joint", "mean (m)",
                                  "most (m)", "frame", "mean (°)", "most (°)", "frame"),
                      Tint::bold));
  for (const auto& joint : joints)
    terminal.result(fmt::format("{:<24} {:>12.6f} {:>12.6f} {:>7} {:>11.5f} {:>11.5f} {:>7}\n", joint.joint,
                                joint.position_mean, joint.position_max, joint.position_frame,
                                joint.rotation_mean, joint.rotation_max, joint.rotation_frame));
}

Json json_of(const Comparison& c) {
  Json::Array joints, only_a(c.only_a.begin(), c.only_a.end()), only_b(c.only_b.begin(), c.only_b.end());
  for (const auto& joint : c.joints)
    joints.push_back(Json::Object{{"joint", joint.joint},
                                  {"other", joint.other},
                                  {"position_mean", joint.position_mean},
                                  {"position_max", joint.position_max},
                                  {"position_frame", joint.position_frame},
                                  {"rotation_mean", joint.rotation_mean},
                                  {"rotation_max", joint.rotation_max},
                                  {"rotation_frame", joint.rotation_frame},
                                  {"offset", joint.offset}});
  return Json::Object{{"identical", c.identical},
                      {"frames", Json::Array{c.frames_a, c.frames_b}},
                      {"fps", Json::Array{c.fps_a, c.fps_b}},
                      {"compared", c.compared},
                      {"position_mean", c.position_mean},
                      {"position_max", c.position_max},
                      {"rotation_mean", c.rotation_mean},
                      {"rotation_max", c.rotation_max},
                      {"joints", joints},
                      {"only_a", only_a},
                      {"only_b", only_b}};
}

// Both files' metrics side by side; per-joint ones only in JSON.
void tell_metrics(const Terminal& terminal, const Metrics& a, const Metrics& b) {
  terminal.result(
      terminal.tinted(fmt::format("{:<28} {:>14} {:>14} {:>14}\n", "metric", "A", "B", "A - B"), Tint::bold));
  for (const auto& metric : a.all) {
    auto dot = metric.name.find('.');
    if (dot != std::string::npos && a.find(metric.name.substr(0, dot))) continue;
    const Metric* other = b.find(metric.name);
    std::optional<double> difference;
    if (other && metric.value && other->value) difference = *metric.value - *other->value;
    terminal.result(fmt::format("{:<28} {:>14} {:>14} {:>14} {}\n", metric.name, text_of(metric.value),
                                other ? text_of(other->value) : "-", text_of(difference), metric.unit));
  }
}

Json json_of(const Metrics& a, const Metrics& b) {
  Json::Object all;
  for (const auto& metric : a.all) {
    const Metric* other = b.find(metric.name);
    all[metric.name] =
        Json::Array{value_or_null(metric.value), other ? value_or_null(other->value) : Json(nullptr)};
  }
  return all;
}

}  // namespace

int compare_command(const Program& program, const CompareArguments& arguments) {
  std::vector<Rule> rules;
  bool needs_metrics = false;
  for (const auto& text : arguments.rules) {
    try {
      rules.push_back(parse_rule(text));
    } catch (const Failure& failure) {
      throw UsageError(failure.diagnostic());
    }
    needs_metrics =
        needs_metrics || !rules.back().name.starts_with("difference.") || !rules.back().baseline.empty();
  }
  auto a = measured(program, arguments.a, needs_metrics), b = measured(program, arguments.b, needs_metrics);
  if (!a.motion != !b.motion)
    throw Failure(error("not-comparable",
                        fmt::format("{} holds a motion and {} metrics", a.motion ? arguments.a : arguments.b,
                                    a.motion ? arguments.b : arguments.a)));
  const auto& terminal = program.terminal;
  Json::Object told;
  Metrics judged;
  if (a.metrics) judged = *a.metrics;
  if (a.motion) {
    check_rates(*a.motion, *b.motion, arguments);
    Alone work;
    auto comparison = compare_motions(*a.motion, *b.motion, {}, work);
    auto differences = metrics_of(comparison);
    judged.all.insert(judged.all.end(), differences.all.begin(), differences.all.end());
    if (arguments.json)
      told = json_of(comparison).object();
    else
      tell_motions(terminal, comparison);
  }
  if (a.metrics && b.metrics) {
    if (arguments.json)
      told["metrics"] = json_of(*a.metrics, *b.metrics);
    else
      tell_metrics(terminal, *a.metrics, *b.metrics);
  }
  int code = exit_code::done;
  Json::Array checks;
  for (const auto& rule : rules) {
    auto outcome = evaluate(rule, judged, b.metrics.get());
    if (!outcome.passed) code = exit_code::checks_failed;
    for (Diagnostic reason : reasons_unmeasured(rule, judged, b.metrics.get())) {
      reason.param.clear();
      terminal.say(reason);
    }
    checks.push_back(Json::Object{{"rule", rule.text},
                                  {"value", value_or_null(outcome.value)},
                                  {"limit", value_or_null(outcome.limit)},
                                  {"passed", outcome.passed}});
    if (!arguments.json)
      terminal.result(fmt::format(
          "{}  {}   measured {}, limit {}\n",
          terminal.tinted(outcome.passed ? "passed" : "failed", outcome.passed ? Tint::green : Tint::red),
          rule.text, text_of(outcome.value), text_of(outcome.limit)));
  }
  if (arguments.json) {
    if (!rules.empty()) told["checks"] = checks;
    terminal.result(indented(Json(std::move(told))));
  }
  return code;
}

}  // namespace kinegraph
