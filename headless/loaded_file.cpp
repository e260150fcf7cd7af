#include "headless/loaded_file.h"

#include <fmt/format.h>

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
      if (said.file.empty()) said.file = session.opened().shown;
      throw Failure(said);
    }
  throw Failure(error("nothing-loaded", "the file gives nothing that can be used here")
                    .in_file(session.opened().shown));
}

}  // namespace kinegraph
