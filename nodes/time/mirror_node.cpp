#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/time/mirror.h"

namespace kinegraph {

NodeType mirror_node() {
  NodeType type;
  type.name = "Mirror";
  type.category = "time";
  type.help =
      "Exchanges left and right: the left arm does what the right one did, and the path is reflected.";
  type.keywords = {"flip", "left", "right", "reflect", "symmetry"};
  type.input("motion", {"Motion"}, "The motion.");
  type.output("motion", "Motion", "The motion as seen in a mirror.", "motion");
  type.param("pairs", list(text("")),
             "Joints that change places, each as LEFT=RIGHT. The others are found by their names (Left and "
             "Right, l and r), "
             "and if no name says anything, by the rest pose.");
  type.compute = [](Compute& compute) {
    const auto& motion = compute.input<Motion>("motion");
    Sides sides = find_sides(motion.skeleton(), compute.params().texts("pairs"), compute.work());
    compute.output("motion", mirrored(motion, sides, compute.work()));
  };
  return type;
}

}  // namespace kinegraph
