#include <fmt/format.h>

#include <filesystem>

#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

int files_command(const Program& program, const RunArguments& arguments, bool json) {
  Session session(program, arguments, open_graph(arguments.graph, program.registry));
  program.terminal.say(session.problems());
  if (!session.valid()) return exit_code::invalid;

  // Relative to the graph's folder, as the graph itself writes them; absolute where that would climb out.
  auto shown = [&](const std::string& path) {
    auto relative =
        std::filesystem::path(path).lexically_normal().lexically_relative(session.opened().folder);
    auto text = relative.generic_string();
    return text.empty() || text.starts_with("..") ? path : text;
  };
  auto reads = session.files_read(), writes = session.files_written();
  std::vector<std::string> nested;
  for (const auto& path : session.plan().graph_files)
    if (path != session.opened().path) nested.push_back(path);

  if (json) {
    auto list = [&](const std::vector<Session::FileUse>& uses) {
      Json::Array all;
      for (const auto& use : uses) {
        Json::Object one{{"node", use.node}, {"path", shown(use.path)}, {"exists", use.exists}};
        if (!use.param.empty()) one["param"] = use.param;
        if (use.companion) one["companion"] = true;
        all.push_back(one);
      }
      return all;
    };
    Json::Array graphs;
    for (const auto& path : nested) graphs.push_back(shown(path));
    program.terminal.result(indented(Json(Json::Object{{"graph", session.opened().shown},
                                                       {"graphs", graphs},
                                                       {"reads", list(reads)},
                                                       {"writes", list(writes)}})));
    return exit_code::done;
  }
  for (const auto& path : nested) program.terminal.result(fmt::format("graph  {}\n", shown(path)));
  for (const auto& use : reads)
    program.terminal.result(fmt::format("read   {}  {}{}\n", shown(use.path),
                                        program.terminal.tinted(use.node, Tint::faint),
                                        use.exists ? "" : program.terminal.tinted("  missing", Tint::red)));
  for (const auto& use : writes)
    program.terminal.result(
        fmt::format("write  {}  {}\n", shown(use.path), program.terminal.tinted(use.node, Tint::faint)));
  return exit_code::done;
}

}  // namespace kinegraph
