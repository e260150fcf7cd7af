#include "headless/outcome.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "graph/file/write.h"
#include "headless/draws/xml_text.h"
#include "headless/exit_code.h"
#include "headless/sha256.h"

namespace kinegraph {

namespace {

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// Six decimals of seconds say enough, and keep the report short.
Json seconds_of(double value) {
  return Json(std::round(value * 1e6) / 1e6);
}

Json all_of(const Diagnostics& diagnostics) {
  Json::Array list;
  for (const auto& diagnostic : diagnostics) list.push_back(to_json(diagnostic));
  return list;
}

Json node_json(const NodeRun& run) {
  Json::Object outputs;
  for (const auto& [port, output] : run.outputs)
    outputs[port] = Json::Object{{"key", output.key},
                                 {"cached", output.cached.empty() ? "no" : output.cached},
                                 {"bytes", output.bytes}};
  return Json::Object{{"type", run.type},
                      {"state", name_of(run.state)},
                      {"seconds", seconds_of(run.seconds)},
                      {"outputs", outputs},
                      {"diagnostics", all_of(run.diagnostics)}};
}

std::string relative_to(const std::string& folder, const std::string& path) {
  return std::filesystem::path(path).lexically_relative(folder).generic_string();
}

std::string said_by(const NodeRun& run) {
  std::string text;
  for (const auto& diagnostic : run.diagnostics)
    if (diagnostic.severity == Severity::error) text += (text.empty() ? "" : "\n") + to_text(diagnostic);
  return text.empty() ? std::string(name_of(run.state)) : text;
}

std::string measured_text(double value, double limit) {
  const auto known = [](double number) {
    return std::isfinite(number) ? shortest_number(number) : "unknown";
  };
  return fmt::format("{}, limit {}",
                     std::isfinite(value) ? "measured " + shortest_number(value) : "not measured",
                     known(limit));
}

bool went_wrong(NodeState state) {
  return state == NodeState::failed || state == NodeState::blocked || state == NodeState::cancelled ||
         state == NodeState::missing;
}

}  // namespace

int exit_of(const RunLog& log, bool dry_run) {
  using exit_code::graver;
  int code = exit_code::done;
  for (const auto& rule : log.rules)
    if (!rule.passed) code = graver(code, exit_code::checks_failed);
  for (const auto& [name, node] : log.nodes)
    if (node.state == NodeState::failed || node.state == NodeState::blocked ||
        node.state == NodeState::cancelled)
      code = graver(code, exit_code::failed);
  if (has_error(log.diagnostics)) code = graver(code, exit_code::invalid);
  if (log.refused || log.missing) code = graver(code, exit_code::invalid);
  if (log.write_failed) code = graver(code, exit_code::cannot_write);
  if (log.timed_out) code = graver(code, exit_code::timed_out);
  std::set<std::string> written;
  for (const auto& file : log.files) written.insert(file.path);
  bool all = true;
  for (const auto& path : log.planned_files) all = all && written.contains(path);
  if (!all && !dry_run) code = graver(code, exit_code::failed);
  return code;
}

Json report_of(const Outcome& outcome, const Program& program, const Opened& opened, const std::string& out) {
  const RunLog& log = outcome.log;
  auto nodes_run = log.nodes;
  for (const auto& [name, node] :
       opened.document.nodes) {  // when nothing ran, the nodes still stand in the report
    if (nodes_run.contains(name)) continue;
    NodeRun& run = nodes_run[name];
    run.type = node.type;
    run.state = node.missing ? NodeState::missing : node.enabled ? NodeState::skipped : NodeState::disabled;
  }
  Diagnostics general = log.diagnostics;
  for (const auto& problem : outcome.problems) {
    auto found = nodes_run.find(problem.node);
    if (found == nodes_run.end())
      general.push_back(problem);
    else
      found->second.diagnostics.push_back(problem);
  }

  Json::Object nodes, metrics;
  for (const auto& [name, run] : nodes_run) nodes[name] = node_json(run);
  Json::Array checks, files;
  for (const auto& rule : log.rules)
    checks.push_back(Json::Object{{"node", rule.node},
                                  {"rule", rule.rule},
                                  {"value", number_or_null(rule.value)},
                                  {"limit", number_or_null(rule.limit)},
                                  {"passed", rule.passed}});
  for (const auto& [node, values] : outcome.metrics) {
    Json::Object measured;
    for (const auto& metric : values->all)
      measured[metric.name] = metric.value ? number_or_null(*metric.value) : Json(nullptr);
    metrics[node] = measured;
  }
  for (const auto& file : log.files)
    files.push_back(Json::Object{{"node", file.node},
                                 {"path", relative_to(out, file.path)},
                                 {"bytes", static_cast<std::size_t>(file.bytes)},
                                 {"sha256", sha256(file.content)}});
  Json::Object report{
      {"format", "kinegraph-report"},
      {"schema", 1},
      {"graph", opened.shown},
      {"version", program.version},
      {"exit", outcome.exit},
      {"seconds", seconds_of(log.seconds)},
      {"threads", Json::Object{{"allowed", log.threads_allowed}, {"used", log.threads_used}}},
      {"nodes", nodes},
      {"checks", checks},
      {"metrics", metrics},
      {"files", files},
  };
  if (!general.empty()) report["diagnostics"] = all_of(general);
  return report;
}

std::string junit_of(const Outcome& outcome, const Program& program, const Opened& opened) {
  const RunLog& log = outcome.log;
  struct Case {
    std::string of, name, inside;
    double seconds;
  };
  std::vector<Case> cases;
  int failures = 0, errors = 0, skipped = 0;
  auto wrong = [&](const std::string& what, const std::string& text) {
    ++errors;
    return fmt::format("<error message=\"{}\">{}</error>", xml_text(what), xml_text(text));
  };
  for (const auto& problem : outcome.problems)
    if (problem.severity == Severity::error)
      cases.push_back({"graph", problem.code, wrong(problem.code, to_text(problem)), 0});

  for (const auto& [name, run] : log.nodes) {
    const NodeType* type = program.registry.find(run.type);
    bool checks = type && type->effect == Effect::checks, writes = type && type->effect == Effect::writes;
    std::size_t rules = 0;
    for (const auto& rule : log.rules) {
      if (rule.node != name) continue;
      ++rules;
      std::string inside;
      if (!rule.passed) {
        ++failures;
        const std::string measured = measured_text(rule.value, rule.limit);
        inside = fmt::format("<failure message=\"{}: {}\">{}</failure>", xml_text(rule.rule),
                             xml_text(measured), xml_text(measured));
      }
      cases.push_back({name, rule.rule, inside, 0});
    }
    bool whole = writes || (checks && rules == 0);
    if (went_wrong(run.state)) {
      cases.push_back({name, run.type, wrong(name_of(run.state), said_by(run)), run.seconds});
    } else if (whole && run.state == NodeState::done) {
      cases.push_back({name, run.type, "", run.seconds});
    } else if (whole) {
      ++skipped;
      cases.push_back({name, run.type, "<skipped/>", 0});
    }
  }
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  text += fmt::format(
      "<testsuites tests=\"{0}\" failures=\"{1}\" errors=\"{2}\">\n"
      "  <testsuite name=\"{3}\" tests=\"{0}\" failures=\"{1}\" errors=\"{2}\" skipped=\"{4}\" "
      "time=\"{5:.3f}\">\n",
      cases.size(), failures, errors, xml_text(opened.shown), skipped, log.seconds);
  for (const auto& one : cases) {
    text += fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", xml_text(one.of),
                        xml_text(one.name), one.seconds);
    text += one.inside.empty() ? "/>\n" : ">" + one.inside + "</testcase>\n";
  }
  return text + "  </testsuite>\n</testsuites>\n";
}

int write_report(const Program& program, const std::string& path, const std::string& text) {
  if (path.empty()) return exit_code::done;
  const std::string whole = absolute_path(path);
  try {
    std::error_code told_by_writing;
    std::filesystem::create_directories(std::filesystem::path(whole).parent_path(), told_by_writing);
    write_file_atomically(whole, text, Lasting::no);
    return exit_code::done;
  } catch (const Failure& failure) {
    program.terminal.say(failure.diagnostic());
    return exit_code::cannot_write;
  }
}

int write_reports(const Outcome& outcome, const Program& program, const RunArguments& arguments,
                  const Opened& opened, const std::string& out) {
  int code = arguments.junit.empty()
                 ? exit_code::done
                 : write_report(program, arguments.junit, junit_of(outcome, program, opened));
  if (!arguments.report.empty()) {
    Outcome told = outcome;
    told.exit = exit_code::graver(outcome.exit, code);
    code = exit_code::graver(
        code, write_report(program, arguments.report, indented(report_of(told, program, opened, out))));
  }
  return code;
}

}  // namespace kinegraph
