#include "nodes/all_nodes.h"

namespace kinegraph {

// One line a type: the function is defined in NAME_node.cpp of its family's folder.

Registry all_nodes() {
  Registry registry;
  return registry;
}

}  // namespace kinegraph
