#include "nodes/gait/gait_styles.h"

#include "graph/diagnostic.h"

namespace kinegraph {
namespace {

GaitStyle walk() {
  GaitStyle style;
  style.name = "walk";
  style.help = "an easy walk, 1.3 m/s";
  return style;
}

GaitStyle run() {
  GaitStyle style;
  style.name = "run";
  style.help = "a run with both feet in the air between steps";
  style.cadence = 2.75;
  style.stride = 1.15;
  style.duty = 0.33;
  style.flat_from = 0.06;
  style.flat_to = 0.15;
  style.landing = 0.14;
  style.push_off = 1.2;
  style.swing_pitch = -0.95;
  style.lift = 0.19;
  style.step_width = 0.06;
  style.toe_out = 0.06;
  style.bob = 0.034;
  style.bob_low = 0.165;
  style.sway = 0.008;
  style.surge = 0.008;
  style.turn = 0.16;
  style.list = 0.05;
  style.tilt = 0.14;
  style.reach = 0.98;
  style.lean = 0.14;
  style.chest_turn = 0.2;
  style.nod = 0.015;
  style.head_pitch = 0.06;
  style.arm_swing = 0.62;
  style.arm_forward = -0.12;
  style.arm_out = 0.22;
  style.arm_out_swing = -0.1;
  style.arm_twist = 0.35;
  style.elbow = 1.5;
  style.elbow_swing = 0.2;
  style.arm_lag = 0.0;
  style.wrist = 0.1;
  style.pronate = 0.3;
  return style;
}

GaitStyle sneak() {
  GaitStyle style;
  style.name = "sneak";
  style.help =
      "on bent knees, one long slow step after the other, ball of the foot first, arms raised in front";
  style.cadence = 1.0;
  style.stride = 0.62;
  style.duty = 0.66;
  style.flat_from = 0.14;
  style.flat_to = 0.48;
  style.landing = -0.3;
  style.push_off = 0.8;
  style.swing_pitch = -0.35;
  style.lift = 0.2;
  style.step_width = 0.16;
  style.toe_out = 0.15;
  style.circle = 0.03;
  style.bob = 0.02;
  style.bob_low = 0.1;
  style.sway = 0.035;
  style.surge = 0.012;
  style.turn = 0.12;
  style.list = 0.03;
  style.tilt = 0.22;
  style.crouch = 0.11;
  style.lean = 0.5;
  style.chest_turn = 0.1;
  style.chest_roll = 0.04;
  style.head_pitch = 0.05;
  style.head_nod = 0.03;
  style.look = 0.3;
  style.arm_swing = 0.22;
  style.arm_forward = 0.55;
  style.arm_out = 0.32;
  style.arm_twist = 0.2;
  style.elbow = 1.75;
  style.elbow_swing = 0.25;
  style.wrist = 0.8;
  style.shrug = 0.18;
  style.pronate = 1.0;
  return style;
}

GaitStyle hobble() {
  GaitStyle style;
  style.name = "hobble";
  style.help = "a limp that spares the right leg";
  style.cadence = 1.45;
  style.stride = 0.48;
  style.duty = 0.66;
  style.flat_from = 0.08;
  style.flat_to = 0.45;
  style.landing = 0.2;
  style.push_off = 0.9;
  style.lift = 0.0;
  style.step_width = 0.16;
  style.toe_out = 0.16;
  style.bob = 0.014;
  style.sway = 0.03;
  style.crouch = 0.015;
  style.lean = 0.2;
  style.tilt = 0.12;
  style.chest_turn = 0.05;
  style.chest_roll = 0.05;
  style.head_pitch = 0.16;
  style.arm_swing = 0.18;
  style.arm_forward = 0.08;
  style.arm_out = 0.2;
  style.elbow = 0.55;
  style.elbow_swing = 0.1;
  style.shrug = 0.1;
  style.limp = 1;
  return style;
}

GaitStyle strut() {
  GaitStyle style;
  style.name = "strut";
  style.help = "proud: chest out, head high, knees up, wide arms";
  style.cadence = 1.6;
  style.stride = 0.7;
  style.duty = 0.595;
  style.landing = 0.42;
  style.push_off = 1.15;
  style.swing_pitch = -0.1;
  style.lift = 0.05;
  style.step_width = 0.1;
  style.toe_out = 0.26;
  style.bob = 0.032;
  style.sway = 0.035;
  style.turn = 0.16;
  style.list = 0.1;
  style.tilt = 0.0;
  style.lean = -0.16;
  style.chest_turn = 0.2;
  style.chest_roll = 0.06;
  style.head_pitch = -0.1;
  style.head_nod = 0.03;
  style.arm_swing = 0.55;
  style.arm_forward = -0.05;
  style.arm_out = 0.36;
  style.arm_out_swing = -0.1;
  style.arm_twist = 0.3;
  style.elbow = 0.62;
  style.elbow_swing = 0.3;
  style.shrug = -0.03;
  return style;
}

GaitStyle stealthy() {
  GaitStyle style;
  style.name = "stealthy";
  style.help = "low and quick on soft feet, body forward, hands ready";
  style.cadence = 1.5;
  style.stride = 0.6;
  style.duty = 0.64;
  style.flat_from = 0.11;
  style.flat_to = 0.44;
  style.landing = -0.22;
  style.push_off = 0.75;
  style.swing_pitch = -0.3;
  style.lift = 0.1;
  style.step_width = 0.1;
  style.bob = 0.008;
  style.sway = 0.02;
  style.turn = 0.14;
  style.list = 0.02;
  style.tilt = 0.26;
  style.crouch = 0.16;
  style.lean = 0.62;
  style.chest_turn = 0.12;
  style.head_pitch = 0.02;
  style.look = 0.18;
  style.arm_swing = 0.26;
  style.arm_forward = 0.5;
  style.arm_out = 0.24;
  style.arm_twist = 0.15;
  style.elbow = 1.3;
  style.elbow_swing = 0.2;
  style.wrist = 0.2;
  style.shrug = 0.12;
  style.pronate = 0.9;
  return style;
}

GaitStyle jaunty() {
  GaitStyle style;
  style.name = "jaunty";
  style.help = "cheerful: springs off the toes, swings arms and shoulders, nods";
  style.cadence = 2.0;
  style.stride = 0.7;
  style.duty = 0.585;
  style.flat_to = 0.27;
  style.landing = 0.36;
  style.push_off = 1.15;
  style.lift = 0.02;
  style.step_width = 0.08;
  style.toe_out = 0.18;
  style.bob = 0.028;
  style.bob_low = 0.04;
  style.sway = 0.03;
  style.turn = 0.17;
  style.list = 0.11;
  style.tilt = 0.02;
  style.lean = -0.05;
  style.chest_turn = 0.19;
  style.chest_roll = 0.09;
  style.nod = 0.03;
  style.head_pitch = -0.04;
  style.head_nod = 0.07;
  style.look = 0.08;
  style.arm_swing = 0.6;
  style.arm_forward = 0.08;
  style.arm_out = 0.24;
  style.arm_twist = 0.25;
  style.elbow = 0.75;
  style.elbow_swing = 0.4;
  return style;
}

GaitStyle stride() {
  GaitStyle style;
  style.name = "stride";
  style.help = "long, strong steps";
  style.cadence = 1.75;
  style.stride = 0.95;
  style.duty = 0.6;
  style.flat_to = 0.32;
  style.landing = 0.46;
  style.push_off = 1.15;
  style.lift = 0.0;
  style.step_width = 0.1;
  style.bob = 0.026;
  style.turn = 0.19;
  style.list = 0.08;
  style.lean = 0.08;
  style.chest_turn = 0.18;
  style.arm_swing = 0.6;
  style.elbow = 0.45;
  style.elbow_swing = 0.35;
  return style;
}

}  // namespace

const std::vector<GaitStyle>& gait_styles() {
  static const std::vector<GaitStyle> all{walk(),  run(),      sneak(),  hobble(),
                                          strut(), stealthy(), jaunty(), stride()};
  return all;
}

const GaitStyle& gait_style(std::string_view name) {
  std::vector<std::string> names;
  for (const GaitStyle& style : gait_styles()) {
    if (style.name == name) return style;
    names.emplace_back(style.name);
  }
  const std::string near = nearest(name, names);
  throw Failure(error("unknown-gait", "there is no gait \"" + std::string(name) + "\"")
                    .at_param("gait")
                    .hinting(near.empty() ? "choose one of the list" : "did you mean \"" + near + "\"?"));
}

}  // namespace kinegraph
