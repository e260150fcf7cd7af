#include <fmt/format.h>

#include <map>

#include "graph/validate_nested.h"
#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

namespace {

// FILE:LINE:COL: severity: code: message — every line in full, so that an editor or a CI can jump to it.
std::string line_of(const Diagnostic& problem, const std::string& file) {
  std::string where;
  if (!problem.node.empty()) where = problem.node;
  if (!problem.port.empty()) where += (where.empty() ? "" : ".") + problem.port;
  if (!problem.param.empty()) where += (where.empty() ? "" : ".") + problem.param;
  return fmt::format("{}:{}:{}: {}: {}: {}{}{}\n", problem.file.empty() ? file : problem.file,
                     std::max(problem.place.line, 1), std::max(problem.place.column, 1),
                     name_of(problem.severity), problem.code, where.empty() ? "" : where + ": ",
                     problem.message, problem.hint.empty() ? "" : " (" + problem.hint + ")");
}

Json json_of(const Diagnostic& problem, const std::string& file) {
  Json::Object object = to_json(problem).object();
  object["file"] = problem.file.empty() ? file : problem.file;
  object["line"] = std::max(problem.place.line, 1);
  object["column"] = std::max(problem.place.column, 1);
  if (!problem.node.empty()) object["node"] = problem.node;
  return object;
}

}  // namespace

int validate_command(const Program& program, const ValidateArguments& arguments) {
  auto variables = parsed_variables(arguments.vars);
  Json::Array all;
  int code = exit_code::done;
  const auto tell = [&](const Diagnostic& problem, const std::string& graph) {
    if (arguments.json) {
      all.push_back(json_of(problem, graph));
    } else {
      auto line = line_of(problem, graph);
      auto word = std::string(name_of(problem.severity));
      auto tint = problem.severity == Severity::error ? Tint::red : Tint::yellow;
      if (program.terminal.colored_results())
        if (auto at = line.find(": " + word + ": "); at != std::string::npos)
          line.replace(at + 2, word.size(), program.terminal.tinted(word, tint));
      program.terminal.result(line);
    }
    bool counts =
        problem.severity == Severity::error || (arguments.strict && problem.severity == Severity::warning);
    if (counts) code = exit_code::invalid;
  };
  std::map<std::string, int> without;  // message of an unused variable, and how many graphs said it
  Diagnostics unused;
  for (const auto& graph : arguments.graphs) {
    Opened opened = open_graph(graph, program.registry);
    FileStore files;
    open_graphs_inside(opened, program.registry, variables, {}, files);
    const ValidateOptions options{.file = graph,
                                  .folder = opened.folder,
                                  .check_files = !arguments.no_files,
                                  .allow_presets = true,
                                  .variables = variables};
    for (const auto& problem : all_problems(opened, program.registry, options)) tell(problem, graph);
    for (const auto& problem : validate_nested(opened.document, program.registry, options))
      tell(problem, graph);
    if (has_error(opened.problems)) continue;
    for (auto& problem : unused_variables(opened, variables, {}))
      if (++without[problem.message] == static_cast<int>(arguments.graphs.size()))
        unused.push_back(std::move(problem));
  }
  for (const auto& problem : unused) tell(problem, arguments.graphs.back());
  if (arguments.json) program.terminal.result(indented(Json(std::move(all))));
  return code;
}

}  // namespace kinegraph
