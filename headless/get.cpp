#include <fmt/format.h>

#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/run_outcome.h"

namespace kinegraph {

namespace {

// "Motion" -> the Export's port for it.
std::string port_for(const NodeType& type, const std::string& value_type) {
  for (const auto& input : type.inputs)
    for (const auto& accepted : input.types)
      if (accepted == value_type) return input.name;
  return {};
}

}  // namespace

int get_command(const Program& program, const RunArguments& arguments, const std::string& port,
                const std::string& file) {
  return run_to_outcome(
      program, arguments, open_graph(arguments.graph, program.registry),
      [&](Session& session) {
        Target wanted = session.target(port);
        if (wanted.port.empty())
          throw UsageError(Diagnostic(error("no-port", fmt::format("{} names a node and no output", port))
                                          .hinting("write NODE.PORT")));
        // An Export that the graph doesn't have is added to the plan, so that every format, rule and message
        // is the same.
        Plan& plan = session.plan();
        const NodeType* type = program.registry.find("Export");
        auto source = plan.find_output(wanted.node, wanted.port);
        if (!source)
          throw UsageError(error(
              "absent-output", fmt::format("{} gives nothing: what it passes on is open or disabled", port)));
        auto value_type = session.type_of(wanted);
        if (value_type.empty()) return std::vector<Target>{wanted};  // a missing node: running it says so
        auto input = type ? port_for(*type, value_type) : std::string();
        if (input.empty())
          throw UsageError(error(
              "no-export", fmt::format("{} is of type {}, which no file format holds", port, value_type)));
        PlannedNode node;
        node.name = "get";
        while (plan.by_name.contains(node.name)) node.name += "_";
        node.type = type;
        node.type_name = type->name;
        for (const auto& param : type->params) node.params[param.name] = *param.fallback;
        node.params["file"] = absolute_path(file);
        node.shown_paths["file"] = file;
        if (type->resolve) type->resolve(node.params);
        node.inputs[input] = {*source};
        // What the command line asks for can't be had: told before anything is computed.
        if (type->misfits)
          for (Diagnostic problem : type->misfits(Params(node.params), {input})) {
            problem.message = fmt::format("-o {}: {}", file, problem.message);
            problem.param.clear();
            problem.port.clear();
            throw UsageError(std::move(problem));
          }
        plan.by_name[node.name] = static_cast<int>(plan.nodes.size());
        plan.effects.push_back(node.name);
        session.options().outside_allowed.push_back(absolute_path(file));
        plan.nodes.push_back(std::move(node));
        return std::vector<Target>{{plan.nodes.back().name, ""}};
      },
      [&](Session&, const Outcome& outcome) {
        for (const auto& written : outcome.log.files)
          program.terminal.message(fmt::format("wrote {} ({})\n", file, size_text(written.bytes)));
        return exit_code::done;
      });
}

}  // namespace kinegraph
