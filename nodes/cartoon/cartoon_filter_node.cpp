#include <algorithm>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/cartoon/cartoon_filter.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/node_params.h"

namespace kinegraph {

NodeType cartoon_filter_node() {
  NodeType type;
  type.name = "CartoonFilter";
  type.code_version = 4;
  type.category = "cartoon";
  type.help =
      "Two other ways to exaggerate, to compare Exaggerate with: the cartoon animation filter and bands of "
      "detail.";
  type.source = "Wang et al., The Cartoon Animation Filter, 2006; Lee & Shin, 2001; Kwon & Lee, Fig. 14";
  type.keywords = {"cartoon", "exaggerate", "anticipation", "laplacian", "Wang", "bands"};
  type.input("motion", {"Motion"}, "the motion to exaggerate");
  type.output("motion", "Motion", "the exaggerated motion", "motion");
  type.param("method",
             choice({{"log", "x − A σ² (x ∗ g″σ): anticipation and overshoot"},
                     {"multiresolution", "each band of detail with a gain of its own"}}),
             "how");
  type.param("on",
             choice({{"angles", "the joints' rotations and the root's path"},
                     {"positions", "the joints' places; links may stretch"}}),
             "what log acts on");
  // As Exaggerate's omega 5: A = (omega − 1)/2, with the same time.
  type.param("strength", number(2).between(-1000, 1000).slider(0, 5), "A of log; 0 is the input");
  type.param("sigma", number(0.12).between(0, 1000).in("s").slider(0.02, 0.5),
             "of log: how long a time it goes over; of multiresolution: of the second band, each is twice "
             "the one before");
  type.param("gains", list(number(1).between(-100, 100)),
             "of multiresolution: one a band, finest first; empty: 1.6, 1.6, 1.3");
  add_joints_param(type);
  add_range_param(type);
  add_fade_param(type);
  add_amount_param(type);
  type.compute = [](Compute& compute) {
    const auto motion = compute.shared_input<Motion>("motion");
    Work& work = compute.work();
    const Params& params = compute.params();
    const auto joints = chosen_joints(params.text("joints"), motion->skeleton(), "joints", work);
    if (motion->frames() == 0) return compute.set_output("motion", motion);
    const auto weights = change_weights(params, motion->frames(), motion->fps());
    Motion result;
    if (params.text("method") == "log") {
      LogFilterParams settings;
      settings.strength = params.number("strength");
      settings.sigma = params.number("sigma");
      settings.on_positions = params.text("on") == "positions";
      result = log_filter(*motion, settings, work);
    } else {
      MultiresolutionParams settings;
      const auto& gains = params.json("gains").array();
      if (!gains.empty()) settings.gains.clear();
      for (const Json& gain : gains) settings.gains.push_back(gain.number());
      settings.sigma = 0.5 * params.number("sigma");
      result = multiresolution_filter(*motion, settings, work);
    }
    const auto whole = [](const auto& all) {
      return std::all_of(all.begin(), all.end(), [](auto one) { return one == 1; });
    };
    if (whole(joints) && whole(weights))
      compute.output("motion", std::move(result));
    else
      compute.output("motion", blended_change(*motion, result, joints, weights));
  };
  return type;
}

}  // namespace kinegraph
