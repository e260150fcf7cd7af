// The registration list: every port type and node type of Kinegraph.
#pragma once
#include "graph/registry.h"

namespace kinegraph {

Registry all_nodes();

}  // namespace kinegraph
