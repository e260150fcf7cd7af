#include "graph/file/dot.h"

#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

int dot_command(const Program& program, const std::string& graph) {
  Opened opened = open_graph(graph, program.registry);
  program.terminal.say(opened.problems);
  if (has_error(opened.problems)) return exit_code::invalid;
  program.terminal.result(dot_text(opened.document, program.registry));
  return exit_code::done;
}

}  // namespace kinegraph
