// A Graph node stands as the nodes inside it do.
#pragma once
#include <map>
#include <string>

#include "gui/evaluation/evaluation.h"

namespace kinegraph {

// Sets the status of `graph` to the most urgent state of the nodes inside it (graph/name), with their times
// together.
void sum_up(std::map<std::string, NodeStatus>& statuses, const std::string& graph);

}  // namespace kinegraph
