#include "graph/builtin_nodes.h"

namespace kinegraph {

NodeType switch_node() {
  NodeType type;
  type.name = "Switch";
  type.category = "graph";
  type.help = "Passes on one of its links, chosen by index. The others are not computed.";
  type.keywords = {"choose", "select", "branch", "if"};
  type.role = Role::select;
  type.list_input("inputs", {}, "What to choose from: links of one type.");
  type.output("output", "", "The chosen link.", "inputs");
  type.param("index", integer(0).between(0, 9007199254740991.0).slider(0, 9),
             "Which link, from 0. One that isn't there is an error.");
  return type;
}

NodeType graph_node() {
  NodeType type;
  type.name = "Graph";
  type.category = "graph";
  type.help =
      "Another graph file as one node. Its inputs, outputs and further parameters are what that file "
      "publishes; Exports "
      "and Checks inside it don't run.";
  type.keywords = {"nested", "subgraph", "group", "reuse", "pipeline", "preset"};
  type.role = Role::graph;
  type.param("file", open_file(), "The graph file.");
  return type;
}

NodeType dot_node() {
  NodeType type;
  type.name = "Dot";
  type.category = "graph";
  type.help = "A bend in a link: passes on what it gets.";
  type.keywords = {"reroute", "bend"};
  type.role = Role::pass;
  type.optional_input("input", {}, "Anything.");
  type.output("output", "", "The same. Absent when nothing is linked.", "input");
  return type;
}

}  // namespace kinegraph
