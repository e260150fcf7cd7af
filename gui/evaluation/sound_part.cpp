#include "gui/evaluation/sound_part.h"

#include "graph/links.h"
#include "graph/validate.h"

namespace kinegraph {

Plan plan_of_sound_part(EvaluationRequest& request, const Registry& registry, const PlanOptions& options,
                        std::map<std::string, Diagnostics>& left_out, Diagnostics& problems) {
  const auto set_aside = [&](const Diagnostics& found) {
    bool any = false;
    for (const Diagnostic& problem : found) {
      if (problem.severity != Severity::error) continue;
      const std::string name = problem.node.substr(0, problem.node.find('/'));
      auto node = request.document.nodes.find(name);
      if (node == request.document.nodes.end() || node->second.missing) continue;
      left_out[name].push_back(problem);
      node->second.missing = to_json(node->second);
      node->second.nested.reset();
      any = true;
    }
    return any;
  };
  for (const std::vector<std::string>& round : cycles(request.document))
    for (const std::string& name : round)
      set_aside({error("cycle", "it is part of a cycle").at_node(name).hinting("cut one of its links")});
  ValidateOptions validating;
  validating.file = request.file;
  validating.folder = request.folder;
  validating.check_files = false;  // a missing file fails the node that reads it
  set_aside(validate(request.document, registry, validating));
  for (;;) {
    problems.clear();
    Plan plan = make_plan(request.document, registry, options, problems);
    if (!has_error(problems) || !set_aside(problems)) return plan;
  }
}

}  // namespace kinegraph
