#include <fmt/format.h>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/node_params.h"
#include "nodes/time/filter.h"

namespace kinegraph {

NodeType filter_node() {
  NodeType type;
  type.name = "Filter";
  type.category = "time";
  type.help = "Smooths a motion in time: takes out shaking and noise above a frequency, without delay.";
  type.keywords = {"smooth", "low-pass", "noise", "jitter", "Butterworth", "Gaussian"};
  type.input("motion", {"Motion"}, "The motion.");
  type.output("motion", "Motion", "The smoothed motion.", "motion");
  type.param("method",
             choice({{"lowpass", "a Butterworth filter, run both ways: keeps what is slow as it is"},
                     {"gaussian", "a weighted mean of neighbouring frames: never overshoots"}}),
             "How it smooths.");
  // Walking and running have next to nothing above 6 Hz but their footfalls.
  type.param("cutoff", number(6).between(0.001, 100000).in("Hz").slider(0.5, 20),
             "Faster movement than this is taken out; at this frequency one half is left.");
  type.param("order", integer(2).between(1, 16).slider(1, 8),
             "How sharply the Butterworth filter cuts; one pass's order.");
  add_joints_param(type);
  add_range_param(type);
  add_fade_param(type);
  add_amount_param(type);
  type.compute = [](Compute& compute) {
    const auto& motion = compute.input<Motion>("motion");
    const Params& params = compute.params();
    FilterSettings settings;
    if (params.text("method") == "gaussian") settings.method = FilterSettings::Method::gaussian;
    settings.cutoff = params.number("cutoff");
    settings.order = static_cast<int>(params.integer("order"));
    auto joints = chosen_joints(params.text("joints"), motion.skeleton(), "joints", compute.work());
    auto weights = change_weights(params, motion.frames(), motion.fps());
    if (2 * settings.cutoff >= motion.fps()) {
      compute.work().report(
          warning("cutoff-too-high", fmt::format("{:.6g} frames per second hold nothing above {:.6g} Hz, "
                                                 "so nothing was taken out",
                                                 motion.fps(), motion.fps() / 2))
              .at_param("cutoff")
              .hinting("choose a cutoff below half the frame rate"));
    }
    compute.output("motion", blended_change(motion, filtered(motion, joints, settings, compute.work()),
                                            joints, weights));
  };
  return type;
}

}  // namespace kinegraph
