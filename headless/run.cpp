#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/metrics_table.h"
#include "headless/run_outcome.h"

namespace kinegraph {

namespace {

std::string shown_path(const std::string& path) {
  auto here =
      std::filesystem::path(path).lexically_relative(std::filesystem::current_path()).generic_string();
  return here.empty() || here.starts_with("../../..") ? path : here;
}

void tell_dry_run(const Terminal& terminal, const Session& session, const RunLog& log) {
  for (const auto& [name, node] : log.nodes) {
    if (node.forecast == Forecast::none) continue;
    bool hit = node.forecast == Forecast::hit;
    terminal.result(fmt::format("{}  {} ({})\n",
                                terminal.tinted(hit ? "hit" : "run", hit ? Tint::green : Tint::yellow), name,
                                node.type));
  }
  for (const auto& read : session.files_read())
    terminal.result(fmt::format("read   {}\n", shown_path(read.path)));
  for (const auto& path : log.planned_files) terminal.result(fmt::format("write  {}\n", shown_path(path)));
}

void tell_results(const Terminal& terminal, const Plan& plan, const Outcome& outcome) {
  const RunLog& log = outcome.log;
  auto columns = metrics_columns(plan, outcome);
  std::vector<std::shared_ptr<const Metrics>> values;
  for (const auto& column : columns) values.push_back(outcome.metrics.at(column));
  if (!columns.empty()) terminal.result(metrics_table(terminal, columns, values) + "\n");
  for (const auto& rule : log.rules) {
    auto number = [](double value) {
      return std::isfinite(value) ? fmt::format("{:.6g}", value) : "unknown";
    };
    auto measured = std::isfinite(rule.value) ? "measured " + number(rule.value) : "not measured";
    terminal.result(
        fmt::format("{}  {}: {}   {}, limit {}\n",
                    terminal.tinted(rule.passed ? "passed" : "failed", rule.passed ? Tint::green : Tint::red),
                    rule.node, rule.rule, measured, number(rule.limit)));
  }
  for (const auto& file : log.files)
    terminal.result(fmt::format("{}   {}  {}\n", terminal.tinted("wrote", Tint::green), shown_path(file.path),
                                terminal.tinted(size_text(file.bytes), Tint::faint)));
}

}  // namespace

int run_command(const Program& program, const RunArguments& arguments) {
  return run_to_outcome(
      program, arguments, open_graph(arguments.graph, program.registry),
      [&](Session& session) {
        std::vector<Target> targets;
        for (const auto& text : arguments.targets) targets.push_back(session.target(text));
        if (arguments.targets.empty()) targets = session.usual_targets();
        if (targets.empty())
          throw UsageError(Diagnostic(
              error("nothing-to-run",
                    fmt::format("{} has no enabled Export or Check and publishes no output", arguments.graph))
                  .hinting("name what to compute with --target NODE.PORT")));
        return targets;
      },
      [&](Session& session, const Outcome& outcome) {
        if (arguments.dry_run)
          tell_dry_run(program.terminal, session, outcome.log);
        else
          tell_results(program.terminal, session.plan(), outcome);
        return exit_code::done;
      });
}

}  // namespace kinegraph
