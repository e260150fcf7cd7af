#include "nodes/all_nodes.h"

namespace kinegraph {

// One line a type: the function is defined in NAME_node.cpp of its family's folder.
NodeType gait_node();

Registry all_nodes() {
  Registry registry;
  registry.add(gait_node());
  return registry;
}

}  // namespace kinegraph
