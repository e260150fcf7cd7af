#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/moving_root.h"
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
  type.code_version = 2;
  type.compute = [](Compute& compute) {
    ConcatenateSettings settings;
    settings.align_root = compute.params().text("align") == "root";
    settings.blend = compute.params().number("blend");
    std::vector<std::shared_ptr<const Motion>> given;
    for (const ValuePtr& value : compute.values("motions"))
      given.push_back(std::dynamic_pointer_cast<const Motion>(value));
    if (settings.align_root && given.size() > 1) given = with_moving_roots(std::move(given), compute.work());
    std::vector<const Motion*> motions;
    for (const auto& motion : given) motions.push_back(motion.get());
    compute.output("motion", concatenated(motions, settings, compute.work()));
  };
  return type;
}

}  // namespace kinegraph
