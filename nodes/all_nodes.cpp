#include "nodes/all_nodes.h"

#include "graph/builtin_nodes.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// One line a type: the function is defined in NAME_node.cpp of its family's folder.
NodeType gait_node();

Registry all_nodes() {
  Registry registry;
  registry.add(ValueType{.name = "Motion", .help = "a skeleton that moves", .decode = decode_motion});
  registry.add(gait_node());
  registry.add(switch_node());
  registry.add(dot_node());
  return registry;
}

}  // namespace kinegraph
