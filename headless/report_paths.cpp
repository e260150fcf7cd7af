#include "headless/report_paths.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

namespace kinegraph {

namespace {

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code failed;
  return a == b || std::filesystem::equivalent(a, b, failed);
}

}  // namespace

void check_report_paths(const RunArguments& arguments, const Session& session) {
  std::vector<std::pair<std::string, std::string>> taken;  // absolute, and what it is
  for (const std::string& graph : session.plan().graph_files)
    taken.emplace_back(graph, "is a graph of this run");
  const std::pair<const char*, const std::string*> reports[] = {
      {"--report", &arguments.report}, {"--junit", &arguments.junit}, {"--html", &arguments.html}};
  bool asked = false;
  for (const auto& [option, path] : reports) asked = asked || !path->empty();
  if (!asked) return;
  if (session.valid()) {
    for (const auto& use : session.files_read()) taken.emplace_back(use.path, "is read by " + use.node);
    for (const auto& use : session.files_written()) taken.emplace_back(use.path, "is written by " + use.node);
  }
  for (const auto& [option, path] : reports) {
    if (path->empty()) continue;
    const std::string file = absolute_path(*path);
    for (const auto& [other, what] : taken)
      if (is_same_file(file, other))
        throw UsageError(error("writes-onto-input", fmt::format("{} {}: that file {}", option, *path, what))
                             .hinting("give it a file of its own"));
    taken.emplace_back(file, fmt::format("is what {} names", option));
  }
}

}  // namespace kinegraph
