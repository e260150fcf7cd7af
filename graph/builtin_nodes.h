// Node types about no motion: they choose or pass on what flows through them, and are gone before keys are made.
#pragma once
#include "graph/node_type.h"

namespace kinegraph {

// Gives the link at `index`, from 0; the others aren't computed. All links are of one type, which the output has.
NodeType switch_node();
// A bend in a link.
NodeType dot_node();
// Another graph file as one node; its ports and further parameters are what that file publishes (see nested.h).
NodeType graph_node();

}  // namespace kinegraph
