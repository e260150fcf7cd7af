#include <fmt/format.h>

#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

int explain_command(const Program& program, const RunArguments& arguments, const std::string& node) {
  Session session(program, arguments, open_graph(arguments.graph, program.registry));
  program.terminal.say(session.problems());
  if (!session.valid()) return exit_code::invalid;
  Target target = session.target(node);
  const Plan& plan = session.plan();

  std::vector<std::string> ports{target.port};
  if (target.port.empty()) {
    if (auto found = plan.by_name.find(target.node); found != plan.by_name.end()) {
      const NodeType* type = plan.nodes[static_cast<std::size_t>(found->second)].type;
      if (type && !type->outputs.empty()) ports = type->output_names();
    } else if (auto passed = plan.passed.find(target.node); passed != plan.passed.end()) {
      ports.clear();
      for (const auto& [port, source] : passed->second) ports.push_back(port);
    }
  }
  const auto& terminal = program.terminal;
  int code = exit_code::done;
  std::string last_parts;
  for (const auto& port : ports) {
    try {
      auto told = session.evaluator().explain(session.plan(), target.node, port);
      auto name = port.empty() ? target.node : target.node + "." + port;
      terminal.result(terminal.tinted(name, Tint::bold) + "\n");
      terminal.result(fmt::format("  key     {}\n", told.has_key ? to_text(told.key) : "none"));
      terminal.result(fmt::format("  cached  {}{}\n", told.cached, told.why.empty() ? "" : ": " + told.why));
      std::size_t width = 0;
      for (const auto& part : told.parts) width = std::max(width, part.what.size());
      std::string parts;
      for (const auto& part : told.parts)
        parts += fmt::format("  {:<{}}  {}\n", part.what, width, part.value);
      terminal.result(!parts.empty() && parts == last_parts ? "  made of the same parts\n" : parts);
      last_parts = parts;
    } catch (const Failure& failure) {
      Diagnostic said = failure.diagnostic();
      if (said.node.empty()) said.node = target.node;
      terminal.say(said);
      code = exit_code::failed;
    }
  }
  return code;
}

}  // namespace kinegraph
