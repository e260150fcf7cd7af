#include "headless/loaded_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace kinegraph {

Opened graph_of_file(const std::string& file) {
  Opened opened;
  opened.shown = file;
  opened.folder = std::filesystem::current_path().string();
  Node load;
  load.type = "Load";
  // Relative to the folder we are in, so that no warning about absolute paths is due.
  load.params["file"] = Json(std::filesystem::proximate(absolute_path(file), opened.folder).generic_string());
  opened.document.nodes["load"] = std::move(load);
  return opened;
}

Diagnostic as_typed(Diagnostic problem, const std::string& path, const std::string& typed) {
  if (problem.file == path) problem.file = typed;
  if (path.empty()) return problem;  // no file was named
  for (std::size_t at = 0; (at = problem.message.find(path, at)) != std::string::npos; at += typed.size())
    problem.message.replace(at, path.size(), typed);
  return problem;
}

std::string hint_without_nodes(std::string hint, const std::vector<std::string>& options) {
  const auto replace = [&](std::string_view from, const std::string& to) {
    const std::size_t at = hint.find(from);
    if (at == std::string::npos) return false;
    hint.replace(at, from.size(), to);
    return true;
  };
  if (replace("set format or another ending", "give it another ending") ||
      replace("set format, or give it that ending", "give it that ending; in a graph: set Load's format") ||
      replace("name the .asf in skeleton",
              "put it beside the .amc; in a graph: name it in Load's skeleton") ||
      replace("raise max_gap, or choose a range", "in a graph: raise Load's max_gap, or choose a range"))
    return hint;
  for (const char* name : {"rest_frame", "clip", "unit", "format"}) {
    if (!hint.starts_with(fmt::format("set {}", name))) continue;
    const bool has_it = std::find(options.begin(), options.end(), name) != options.end();
    replace(fmt::format("set {}", name),
            fmt::format(fmt::runtime(has_it ? "set --{}" : "in a graph: set Load's {}"), name));
    break;
  }
  return hint;
}

LoadedFile load_file(Session& session, const Program& program, const std::string& port) {
  std::vector<std::string> ports{port};
  if (port.empty()) {
    ports.clear();
    for (const auto& output : program.registry.find("Load")->outputs) ports.push_back(output.name);
  }
  Progress silent(Progress::Form::none, program.terminal);
  Diagnostics first;
  for (const auto& name : ports) {
    RunLog log = session.run({{"load", name}}, silent, nullptr);
    const auto& said = log.nodes["load"].diagnostics;
    if (auto value = session.evaluator().value(session.plan(), "load", name)) {
      for (auto note : said) {
        if (note.severity == Severity::info) continue;  // `kinegraph info` tells those
        note.node.clear();
        note.hint = hint_without_nodes(std::move(note.hint));
        if (note.file.empty()) note.file = session.opened().shown;
        program.terminal.say(note);
      }
      return {value, name};
    }
    if (first.empty()) first = said;
  }
  for (const auto& problem : first)
    if (problem.severity == Severity::error) {
      Diagnostic said = problem;
      said.node.clear();
      said.hint = hint_without_nodes(std::move(said.hint));
      if (said.file.empty()) said.file = session.opened().shown;
      throw Failure(said);
    }
  throw Failure(error("nothing-loaded", "the file gives nothing that can be used here")
                    .in_file(session.opened().shown));
}

}  // namespace kinegraph
