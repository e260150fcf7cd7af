#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/time/concatenate.h"

namespace kinegraph {

NodeType concatenate_node() {
  NodeType type;
  type.name = "Concatenate";
  type.category = "time";
  type.help = "Joins motions one after the other, each going on from where the one before it ends.";
  type.keywords = {"join", "append", "sequence", "transition", "chain"};
  type.list_input("motions", {"Motion"}, "The motions in order; the same joints and rate.");
  type.output("motion", "Motion", "All of them as one.", "motions");
  type.param(
      "align",
      choice({{"root", "turns and moves each motion on the ground so that it goes on from the one before"},
              {"none", "leaves each where it is"}}),
      "Where each motion after the first begins.");
  type.param("blend", number(0).between(0, 3600).in("s").slider(0, 1),
             "How long neighbours overlap and fade into each other; 0 = one frame after the other.");
  type.compute = [](Compute& compute) {
    std::vector<const Motion*> motions;
    for (const ValuePtr& value : compute.values("motions"))
      motions.push_back(&dynamic_cast<const Motion&>(*value));
    ConcatenateSettings settings;
    settings.align_root = compute.params().text("align") == "root";
    settings.blend = compute.params().number("blend");
    compute.output("motion", concatenated(motions, settings, compute.work()));
  };
  return type;
}

}  // namespace kinegraph
