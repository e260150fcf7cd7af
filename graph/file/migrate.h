// Bringing a stored node up to its type's current version, in memory.
#pragma once
#include "graph/json.h"
#include "graph/node_type.h"

namespace kinegraph {

// `node` is a node's object as in the file, of version `from` < type.version. Its params and inputs are rewritten step by
// step and its version is set; what a step leaves alone keeps its place in the file.
void migrate_node(const NodeType& type, int from, Json::Object& node);

}  // namespace kinegraph
