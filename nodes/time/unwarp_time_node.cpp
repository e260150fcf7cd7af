#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/time/unwarp_time.h"

namespace kinegraph {

NodeType unwarp_time_node() {
  NodeType type;
  type.name = "UnwarpTime";
  type.category = "time";
  type.help = "Takes a motion on TimeWarp's clock, usually edited since, back to the source's own timing.";
  type.source = "Wu, On-line Motion Style Transfer, §6";
  type.keywords = {"timing", "unwarp", "inverse"};
  type.input("motion", {"Motion"}, "TimeWarp's `warped`, or what was made of it.");
  type.input("warp", {"Warp"}, "TimeWarp's `warp`.");
  type.output("motion", "Motion", "The motion in the source's timing.", "motion");
  type.compute = [](Compute& node) {
    const auto& warp = node.input<Warp>("warp");
    const auto& motion = node.input<Motion>("motion");
    node.output("motion", unwarp_time(motion, warp, node.work()));
  };
  return type;
}

}  // namespace kinegraph
