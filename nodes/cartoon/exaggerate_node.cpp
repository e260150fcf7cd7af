#include <algorithm>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/cartoon/exaggerate.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/node_params.h"

namespace kinegraph {
namespace {

// Chosen by looking at walk, run, kick, dance and boxing: a quarter second makes walks wade, a twentieth only
// sharpens the mocap's noise.
constexpr double default_sigma = 0.12;
// With the links' mean error under 3 % limbs still visibly stretch where they are fast and no longer fly
// apart.
constexpr double default_error = 0.03;

std::vector<double> weights_of(const Params& params, const Skeleton& skeleton, Work& work) {
  std::vector<std::string> patterns;
  std::vector<double> values;
  for (const auto& [pattern, value] : params.json("weights").object()) {
    patterns.push_back(pattern);
    values.push_back(value.number());
  }
  std::vector<double> weights;
  for (int at : most_specific(patterns, skeleton, "weights", work))
    weights.push_back(at < 0 ? 1 : values[at]);
  return weights;
}

ExaggerateParams settings_of(const Params& params, const Motion& motion, Work& work) {
  ExaggerateParams settings;
  settings.omega = params.number("omega");
  settings.sigma = params.number("sigma");
  settings.weights = weights_of(params, motion.skeleton(), work);
  settings.keep_root = params.text("root") == "keep";
  settings.correct = params.boolean("correct");
  settings.correction.delta = params.number("delta");
  settings.correction.error = params.number("error");
  settings.correction.max_link = params.number("max_link");
  settings.correction.iterations = static_cast<int>(params.integer("iterations"));
  settings.wished_stretch = params.number("auto");
  const auto over_one = [&](const char* name) {
    const double value = params.number(name);
    if (value != 0 && !(value > 1))
      throw Failure(error("bad-value", "a link can't be wished shorter than it is")
                        .at_param(name)
                        .hinting("0 turns it off; else a number above 1, such as 1.5"));
  };
  over_one("max_link");
  over_one("auto");
  return settings;
}

}  // namespace

NodeType exaggerate_node() {
  NodeType type;
  type.name = "Exaggerate";
  type.code_version = 8;
  type.category = "cartoon";
  type.help =
      "Exaggerates a motion: every joint swings further from its own average over time, and limbs stretch "
      "where they are fast.";
  type.source = "Kwon & Lee, Exaggerating Character Motions Using Sub-Joint Hierarchy, §4, Fig. 4";
  type.keywords = {"cartoon", "squash", "stretch", "anticipation", "amplify", "Kwon"};
  type.input("motion", {"Motion"}, "the motion to exaggerate");
  type.output("motion", "Motion", "the exaggerated motion, with links of changing length", "motion");
  type.param("omega", number(5).between(0, 1000).slider(1, 10), "how much; 1 is the input");
  type.param("sigma", number(default_sigma).between(0, 1000).in("s").slider(0.02, 0.5),
             "how long a time the average goes over: slow swings need a long one");
  type.param("weights", table(number(1).between(-100, 100)),
             "joint pattern to weight: how much of omega a joint gets; 1 where nothing is said");
  type.param("root",
             choice({{"exaggerate", "like every joint, on its way through the world"},
                     {"keep", "the root keeps its path, the others are exaggerated relative to it"}}),
             "what happens to the root");
  type.param("correct", boolean(true), "pull links back towards their lengths");
  type.param("delta", number(0.5).between(1e-6, 0.5).slider(0.05, 0.5),
             "part of a link's violation that one iteration takes away; halved when the error rises");
  type.param("error", number(default_error).between(0, 1000).slider(0, 0.3),
             "the correction ends when links are wrong by this part of their length in the mean");
  type.param("max_link", number(0).between(0, 1000).slider(1, 3),
             "the correction goes on until no link is longer than this times its length; 0 = no such bound");
  type.param("iterations", integer(100).between(0, 100000), "most iterations of the correction");
  type.param("auto", number(0).between(0, 1000).slider(0, 3),
             "a wished largest stretch, such as 1.5: sigma and omega are then chosen to reach it, and only "
             "max_link is corrected; 0 = off");
  add_joints_param(type);
  type.params.back().help +=
      " Of a joint that is its rotation and the length of the link to it; where that link points is its "
      "parent's rotation: choose whole limbs (LeftArm>), or give weights.";
  add_range_param(type);
  add_fade_param(type);
  add_amount_param(type);
  type.compute = [](Compute& compute) {
    const auto motion = compute.shared_input<Motion>("motion");
    Work& work = compute.work();
    const Params& params = compute.params();
    const ExaggerateParams settings = settings_of(params, *motion, work);
    const auto joints = chosen_joints(params.text("joints"), motion->skeleton(), "joints", work);
    if (motion->frames() == 0) return compute.set_output("motion", motion);
    const MotionPart part{joints, change_weights(params, motion->frames(), motion->fps())};
    const auto whole = [](const auto& all) {
      return std::all_of(all.begin(), all.end(), [](auto one) { return one == 1; });
    };
    const bool all = whole(part.joints) && whole(part.weights);
    compute.output("motion", exaggerate(*motion, settings, work, all ? nullptr : &part).motion);
  };
  return type;
}

}  // namespace kinegraph
