// What of a graph can be evaluated: half of the graphs that a person edits aren't whole.
#pragma once
#include <map>
#include <string>

#include "graph/plan.h"
#include "graph/registry.h"
#include "gui/evaluation/evaluation.h"

namespace kinegraph {

// Nodes that something is wrong with stand aside as missing in the request's document and are told in
// `left_out`, so that all that doesn't depend on them still runs. What is wrong and of no node stays in
// `problems`.
Plan plan_of_sound_part(EvaluationRequest& request, const Registry& registry, const PlanOptions& options,
                        std::map<std::string, Diagnostics>& left_out, Diagnostics& problems);

}  // namespace kinegraph
