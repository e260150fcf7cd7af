#include <fmt/format.h>

#include "graph/reference.h"
#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

int nodes_command(const Program& program, const std::string& type, ReferenceForm form) {
  const NodeType* found = nullptr;
  if (!type.empty()) {
    found = program.registry.find(type);
    if (!found)
      throw UsageError(Diagnostic(error("unknown-type", fmt::format("there is no node type \"{}\"", type))
                                      .hinting(suggestion(type, program.registry.names()))));
  }
  switch (form) {
    case ReferenceForm::text:
      program.terminal.result(found ? reference_text(*found) : reference_list(program.registry));
      break;
    case ReferenceForm::markdown:
      program.terminal.result(found ? reference_markdown(*found) : reference_markdown(program.registry));
      break;
    case ReferenceForm::json:
      program.terminal.result(indented(found ? reference_json(*found) : reference_json(program.registry)));
      break;
  }
  return exit_code::done;
}

}  // namespace kinegraph
