#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/motion/moving_root.h"
#include "nodes/node_params.h"
#include "nodes/style/quat_stats.h"

namespace kinegraph {

NodeType quat_stats_node() {
  NodeType type;
  type.name = "QuatStats";
  type.category = "style";
  type.help =
      "Measures the style of a motion: each joint's mean rotation and spread, and those of the root's travel "
      "and height.";
  type.source = "Wu, On-line Motion Style Transfer, §5; eq. 6 with its weights corrected";
  type.keywords = {"statistics", "mean", "variance", "spread", "Karcher", "style"};
  type.input("motion", {"Motion"}, "the motion to measure");
  type.output("stats", "Stats", "means and spreads");
  type.param("mean",
             choice({{"karcher",
                      "the rotation whose logs to all frames sum to zero; it doesn't depend on their order"},
                     {"slerp", "the paper's running mean, q̄ₙ = Slerp(1/n, q̄ₙ₋₁, qₙ)"}}),
             "which mean of rotations");
  type.param("space",
             choice({{"quaternion", "means and spreads of whole rotations"},
                     {"euler", "of each Euler angle in the file's own order, for comparison"}}),
             "what is averaged");
  add_joints_param(type);
  add_range_param(type);
  type.code_version = 2;
  type.compute = [](Compute& compute) {
    const auto told = with_moving_root(compute.shared_input<Motion>("motion"), compute.work());
    const Motion& motion = *told;
    const Params& params = compute.params();
    QuatStatsParams settings;
    settings.mean = params.text("mean") == "slerp" ? MeanKind::slerp : MeanKind::karcher;
    settings.space = params.text("space") == "euler" ? StyleSpace::euler : StyleSpace::quaternion;
    settings.joints = chosen_joints(params.text("joints"), motion.skeleton(), "joints", compute.work());
    const Frames frames = checked_range(params.range("range"), motion.frames(), "range");
    settings.start = frames.start;
    settings.end = frames.end;
    compute.output("stats", quat_stats(motion, settings, compute.work()));
  };
  return type;
}

}  // namespace kinegraph
