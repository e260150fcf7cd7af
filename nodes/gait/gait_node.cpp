#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/gait/gait.h"
#include "nodes/gait/gait_styles.h"

namespace kinegraph {
namespace {

GaitParams gait_params(const Params& params) {
  GaitParams result;
  result.gait = params.text("gait");
  result.speed = params.number("speed");
  result.cadence = params.number("cadence");
  result.stride = params.number("stride");
  result.bounce = params.number("bounce");
  result.lean = params.number("lean");
  result.crouch = params.number("crouch");
  result.arm_swing = params.number("arm_swing");
  result.limp = params.number("limp");
  result.seconds = params.number("seconds");
  result.fps = params.number("fps");
  result.seed = static_cast<std::uint64_t>(params.integer("seed"));
  return result;
}

}  // namespace

NodeType gait_node() {
  const GaitParams defaults;
  NodeType type;
  type.name = "Gait";
  type.category = "motion";
  type.help =
      "Makes a person walk, run, sneak, hobble or strut on a standard skeleton, with feet that plant. Needs "
      "no file.";
  type.keywords = {"walk", "run", "source", "generate", "procedural"};
  std::vector<ParamType::Choice> gaits;
  for (const GaitStyle& style : gait_styles())
    gaits.push_back({std::string(style.name), std::string(style.help)});
  type.param("gait", choice(std::move(gaits)), "The way of going.");
  type.param("speed", number(defaults.speed).between(0, 12).in("m/s").slider(0, 5),
             "Speed; 0 = the gait's own, or cadence times stride.");
  type.param("cadence", number(defaults.cadence).between(0, 6).in("steps/s").slider(0, 4),
             "Steps a second; 0 = the gait's own, or what speed and stride make.");
  type.param("stride", number(defaults.stride).between(0, 4).in("m").slider(0, 1.5),
             "Length of a step; 0 = the gait's own, or what speed and cadence make.");
  type.param("bounce", number(defaults.bounce).between(0, 4).slider(0, 2),
             "Rise and fall, times the gait's own.");
  type.param("lean", number(defaults.lean).between(-45, 60).in("°").slider(-20, 30),
             "Leans further forwards, degrees.");
  type.param("crouch", number(defaults.crouch).between(-0.2, 0.4).slider(0, 0.25),
             "Lower on bent knees, as a part of the leg's length.");
  type.param("arm_swing", number(defaults.arm_swing).between(0, 4).slider(0, 2),
             "Swing of the arms, times the gait's own.");
  type.param("limp", number(defaults.limp).between(0, 1).slider(0, 1), "How much the right leg is spared.");
  type.param("seconds", number(defaults.seconds).between(0.01, 3600).in("s").slider(1, 20),
             "Length of the motion.");
  type.param("fps", number(defaults.fps).between(1, 1000).in("frames/s").slider(24, 240), "Frames a second.");
  type.param("seed", integer(0).between(0, 9007199254740991.0),
             "Varies steps, arms and head a little; 0 = not at all.");
  type.output("motion", "Motion", "The motion: 23 joints, 1.75 m tall, along +Z.");
  type.compute = [](Compute& node) {
    node.output("motion", make_gait(gait_params(node.params()), node.work()));
  };
  return type;
}

}  // namespace kinegraph
