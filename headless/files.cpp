#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

int files_command(const Program& program, const RunArguments& arguments, bool json) {
  Session session(program, arguments, open_graph(arguments.graph, program.registry));
  program.terminal.say(session.problems());
  if (!session.valid()) return exit_code::invalid;

  // Relative to the graph's folder, as the graph itself writes them; absolute where only the root is common.
  const std::filesystem::path folder = session.opened().folder;
  auto shown = [&](const std::string& path) {
    auto normal = std::filesystem::path(path).lexically_normal();
    auto relative = normal.lexically_relative(folder);
    auto climbs = std::count(relative.begin(), relative.end(), std::filesystem::path(".."));
    auto depth = std::distance(folder.begin(), folder.end()) - 1;  // without the root itself
    return (relative.empty() || climbs >= depth ? normal : relative).generic_string();
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
