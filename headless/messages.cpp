#include "headless/messages.h"

#include <algorithm>

namespace kinegraph {

namespace {

// Nodes that say the same of the same parameter share a line: "sneak.unit, walk.unit: ...".
Diagnostics joined(Diagnostics all) {
  Diagnostics lines;
  for (auto& one : all) {
    auto same = std::find_if(lines.begin(), lines.end(), [&](const Diagnostic& line) {
      return line.code == one.code && line.message == one.message && line.hint == one.hint &&
             line.param == one.param && line.port == one.port && line.joint == one.joint &&
             line.frame == one.frame && line.file == one.file;
    });
    if (same == lines.end() || one.node.empty()) {
      lines.push_back(std::move(one));
      continue;
    }
    const std::string& part = one.port.empty() ? one.param : one.port;
    same->node += (part.empty() ? "" : "." + part) + ", " + one.node;
  }
  return lines;
}

}  // namespace

void say_log(const Terminal& terminal, const RunLog& log, const std::string& graph, bool tell_infos) {
  Diagnostics infos, warnings, failures, blocked;
  auto sort_in = [&](Diagnostic diagnostic) {
    if (diagnostic.severity == Severity::info)
      infos.push_back(std::move(diagnostic));
    else if (diagnostic.severity == Severity::warning)
      warnings.push_back(std::move(diagnostic));
    else
      (diagnostic.code == "blocked" ? blocked : failures).push_back(std::move(diagnostic));
  };
  for (const auto& [name, node] : log.nodes)
    for (auto diagnostic : node.diagnostics) {
      if (diagnostic.node.empty()) diagnostic.node = name;
      sort_in(std::move(diagnostic));
    }
  for (auto diagnostic : log.diagnostics) {
    if (diagnostic.file.empty() && diagnostic.severity == Severity::error) diagnostic.file = graph;
    sort_in(std::move(diagnostic));
  }
  if (tell_infos) terminal.say(joined(std::move(infos)));
  for (const auto* part : {&warnings, &failures, &blocked}) terminal.say(*part);
  if (log.timed_out) terminal.message("kinegraph: timed out\n");
}

}  // namespace kinegraph
