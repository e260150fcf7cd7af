#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/time/trim.h"

namespace kinegraph {

NodeType trim_node() {
  NodeType type;
  type.name = "Trim";
  type.category = "time";
  type.help = "Keeps a stretch of a motion and drops the frames before and after it.";
  type.keywords = {"cut", "crop", "range", "frames", "shorten"};
  type.input("motion", {"Motion"}, "The motion.");
  type.output("motion", "Motion", "Its frames from the range's start up to but without its end.", "motion");
  type.param("range", range(),
             "The frames to keep, from the first up to but without the second; null goes to the end.");
  type.compute = [](Compute& compute) {
    const auto& motion = compute.input<Motion>("motion");
    compute.output("motion",
                   trimmed(motion, checked_range(compute.params().range("range"), motion.frames(), "range")));
  };
  return type;
}

}  // namespace kinegraph
