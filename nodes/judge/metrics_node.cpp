#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/judge/measures.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/node_params.h"

namespace kinegraph {

NodeType metrics_node() {
  NodeType type;
  type.name = "Metrics";
  type.category = "judge";
  type.help =
      "Measures a motion: skating feet, smoothness, bone lengths, and how far it is from a reference in pose "
      "and in style.";
  type.source = "sparc: Balasubramanian et al., On the analysis of movement smoothness, 2015";
  type.keywords = {"measure", "quality", "skate", "jerk", "smoothness", "distance", "style distance"};
  type.input("motion", {"Motion"}, "the motion to measure");
  type.optional_input("reference", {"Motion"}, "what distances are measured to; open: they are null");
  type.optional_input("contacts", {"Contacts"},
                      "when feet are planted; open: DetectContacts' defaults on motion");
  type.output("metrics", "Metrics", "named numbers; what can't be had is null");
  add_joints_param(type);
  add_range_param(type);
  add_map_param(type);
  type.code_version = 5;
  type.compute = [](Compute& compute) {
    const auto& motion = compute.input<Motion>("motion");
    const Params& params = compute.params();
    MeasureParams settings;
    settings.joints = chosen_joints(params.text("joints"), motion.skeleton(), "joints", compute.work());
    const Frames frames = checked_range(params.range("range"), motion.frames(), "range");
    settings.window = {frames.start, frames.end};
    settings.map = params.texts("map");
    compute.output("metrics",
                   measure(motion, compute.optional_input<Motion>("reference"),
                           compute.optional_input<Contacts>("contacts"), settings, compute.work()));
  };
  return type;
}

}  // namespace kinegraph
