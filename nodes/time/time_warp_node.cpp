#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/moving_root.h"
#include "nodes/node_params.h"
#include "nodes/time/time_warp.h"

namespace kinegraph {
namespace {

void compute(Compute& node) {
  const auto told = with_moving_root(node.shared_input<Motion>("source"), node.work());
  const auto told_reference = with_moving_root(node.shared_input<Motion>("reference"), node.work());
  const Motion &source = *told, &reference = *told_reference;
  check_same_rate(source.fps(), reference.fps(), "source", "reference");
  const Params& params = node.params();
  TimeWarpSettings settings;
  settings.scale_and_offset = params.text("method") == "imw";
  settings.features = params.text("features");
  settings.per_dof = params.text("correspondence") == "per-dof";
  settings.scale_smoothness = params.number("scale_smoothness");
  settings.offset_smoothness = params.number("offset_smoothness");
  settings.max_step = static_cast<std::size_t>(params.integer("max_step"));
  settings.free_ends = params.text("ends") == "free";
  settings.iterations = static_cast<int>(params.integer("iterations"));
  settings.tolerance = params.number("tolerance");
  settings.map = params.texts("map");

  TimeWarpResult result = time_warp(source, reference, settings, node.work());
  if (result.warped)
    node.output("warped", std::move(*result.warped));
  else
    node.set_output("warped", node.values("source").front());
  if (result.reference)
    node.output("reference", std::move(*result.reference));
  else
    node.set_output("reference", node.values("reference").front());
  node.output("warp", std::move(result.warp));
}

}  // namespace

NodeType time_warp_node() {
  const TimeWarpSettings defaults;
  NodeType type;
  type.name = "TimeWarp";
  type.category = "time";
  type.help =
      "Lays two motions on one clock, so that the same thing happens at the same frame. The longer motion's "
      "clock is kept; "
      "the other one is stretched and squeezed to it.";
  type.source = "Wu, On-line Motion Style Transfer, §4, eq. 1-3; Hsu et al. 2005, iterative motion warping";
  type.keywords = {"align", "dtw", "imw", "timing", "synchronise", "correspondence"};
  type.input("source", {"Motion"}, "The motion to be changed later.");
  type.input("reference", {"Motion"}, "The motion to compare it with, of the same rate.");
  type.output(
      "warped", "Motion",
      "The source's poses on the shared clock, made for measuring and transferring; where the clock holds a "
      "frame its travel is repeated, so it is no finished retimed clip: UnwarpTime takes it back.",
      "source");
  type.output("reference", "Motion", "The reference on the shared clock.", "reference");
  type.output("warp", "Warp", "What UnwarpTime needs to go back to the source's timing.");
  type.outputs.back().constant = [] { return std::make_shared<const Warp>(); };
  type.param(
      "method",
      choice({{"imw", "iterative motion warping: looks past differences of size and offset that vary slowly"},
              {"dtw", "dynamic time warping: compares the motions as they are"}}),
      "How the motions are compared.");
  type.param("features", pattern(defaults.features),
             "What is compared: joints, `root` for its travel, height and turning, or single DOFs such as "
             "LeftUpLeg.x.");
  type.param("correspondence",
             choice({{"shared", "one path for the whole body"},
                     {"per-dof",
                      "each DOF is warped by itself, as Wu describes it; limbs may lose their timing among "
                      "each other"}}),
             "Whether all of the body follows one path.");
  type.param(
      "scale_smoothness", number(defaults.scale_smoothness).between(0, 1e6).slider(0, 500),
      "How slowly the scale between the motions may vary (weight of F). Larger: closer to plain warping.");
  type.param("offset_smoothness", number(defaults.offset_smoothness).between(0, 1e6).slider(0, 500),
             "How slowly the offset between the motions may vary (weight of G).");
  type.param(
      "max_step", integer(0).between(0, 1e6).in("frames").slider(0, 10),
      "Most frames a step may advance, and most rows a frame may be held. 0: max(3, longer / shorter + 1).");
  type.param("ends",
             choice({{"fixed", "first meets first, last meets last"},
                     {"free", "up to max_step frames may be left off at each end"}}),
             "What the ends of the shorter motion do.");
  type.param("iterations", integer(defaults.iterations).between(1, 1000).slider(1, 50),
             "Most rounds; it stops by itself when the path repeats.");
  type.param("tolerance", number(defaults.tolerance).between(0, 1).slider(0, 0.1),
             "Stops when scale and offset change by less.");
  add_map_param(type);
  type.code_version = 4;
  type.compute = compute;
  return type;
}

}  // namespace kinegraph
