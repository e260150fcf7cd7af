#include "headless/version_of_graph.h"

#include <fmt/format.h>

#include <filesystem>

namespace kinegraph {

Opened version_of_graph(const std::string& argument, const Registry& registry) {
  std::error_code failed;
  const bool nothing = argument == "/dev/null" || (std::filesystem::is_regular_file(argument, failed) &&
                                                   std::filesystem::file_size(argument, failed) == 0);
  if (!nothing) return open_graph(argument, registry);
  Opened opened;
  opened.shown = argument;
  return opened;
}

bool usable_version(const Program& program, const Opened& opened, bool infos) {
  for (const Diagnostic& problem : opened.problems)
    if (infos || problem.severity != Severity::info) program.terminal.say(problem);
  if (has_error(opened.problems)) return false;
  if (!opened.document.read_only) return true;
  program.terminal.say(error("newer-schema", "the file is of a newer schema and is left as it is")
                           .in_file(opened.shown)
                           .hinting("use a newer version of kinegraph"));
  return false;
}

}  // namespace kinegraph
