#include "nodes/gait/gait_body.h"

#include "nodes/gait/gait_foot.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

const Vec3 x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};

// 1 where the phase is `peak`, -1 half a turn away.
double wave(double cycles, double peak) {
  return cosine(2 * pi * (cycles - peak));
}

// About up, then forwards, then to the right.
Quat turned(double turn, double forwards, double to_right) {
  return axis_angle(y_axis, turn) * axis_angle(x_axis, forwards) * axis_angle(z_axis, to_right);
}

Quat mirrored(Quat q) {
  return {q.x, -q.y, -q.z, q.w};
}  // left and right exchanged

// A slow wander around 1 that no cycle repeats.
double wander(std::uint64_t seed, std::uint64_t channel, double cycles, double size) {
  if (seed == 0) return 1;
  const double first = variation(seed, channel, 0), second = variation(seed, channel, 1);
  return 1 +
         size * (sine(2 * pi * (0.173 * cycles + first)) + 0.6 * sine(2 * pi * (0.311 * cycles + second)));
}

// The left arm, T-pose at rest along +X; `cycles` of the left foot. The right arm is its mirror image half a
// cycle on.
BodyPose::Arm arm_pose(const GaitStyle& style, double cycles, double strength) {
  const double swing = wave(cycles, 0.5 + style.arm_lag) + 0.08 * wave(2 * cycles, 2 * style.arm_lag);
  const double bend_swing = wave(cycles, 0.5 + style.arm_lag + 0.07);
  const double forward = style.arm_forward + strength * style.arm_swing * (swing + 0.12);
  const double out = style.arm_out + style.arm_out_swing * strength * swing;
  const double bend = style.elbow + strength * style.elbow_swing * bend_swing;
  BodyPose::Arm arm;
  arm.shoulder = axis_angle(z_axis, style.shrug) * axis_angle(y_axis, -0.12 * forward);
  // Down from the T-pose, then out; the shrug is taken back so that the arm still hangs.
  const Quat hang = axis_angle(z_axis, out - pi / 2 - style.shrug);
  arm.arm = axis_angle(x_axis, -0.88 * forward) * hang * axis_angle(x_axis, style.arm_twist);
  arm.fore_arm = axis_angle(y_axis, -bend) * axis_angle(x_axis, style.pronate);
  arm.hand = axis_angle(z_axis, -style.wrist - 0.12 * strength * bend_swing);
  return arm;
}

}  // namespace

BodyPose body_pose(const GaitStyle& style, double cycles, double seconds, double speed, std::uint64_t seed) {
  const double limp = style.limp;
  const double stands = style.duty / 2;  // phase in the middle of the left foot's stance
  const double vigour = wander(seed, 11, cycles, 0.07);
  BodyPose pose;
  // A limp falls onto the sore right leg and is quickly off it again.
  const double falls = wave(cycles, 0.62) + 0.3 * wave(2 * cycles, 0.24);
  pose.hips = {style.sway * wave(cycles, stands) - 0.012 * limp * wave(cycles, 0.7),
               -style.bob * wave(2 * cycles, 2 * style.bob_low) - 0.016 * limp * falls,
               speed * seconds + style.surge * wave(2 * cycles, 0.02) + 0.02 * limp * wave(cycles, 0.55)};
  const double left_ahead = wave(cycles, 0);  // the left leg is out in front
  const double on_left = wave(cycles, stands - 0.06);
  const double pelvis_turn = -style.turn * left_ahead;
  const double hangs_right = style.list * on_left;  // the swinging side hangs
  pose.pelvis = turned(pelvis_turn, style.tilt + 0.5 * style.nod * wave(2 * cycles, 0.1), hangs_right);

  const double chest_right =
      -style.chest_roll * wave(cycles, stands) + limp * (0.03 + 0.07 * wave(cycles, 0.72));
  const Quat chest =
      turned(style.chest_turn * wave(cycles, 0.02) * vigour,
             style.lean + style.nod * wave(2 * cycles, 0.12) + 0.05 * limp * wave(cycles, 0.66), chest_right);
  const double look = style.look * sine(2 * pi * cycles / 2) * wander(seed, 12, cycles, 0.3);
  const Quat face = turned(
      look + 0.15 * style.chest_turn * left_ahead,
      style.head_pitch + style.head_nod * wave(2 * cycles, 0.16) + 0.02 * (wander(seed, 13, cycles, 1) - 1),
      0.35 * chest_right);
  const Quat waist = slerp(0.45, pose.pelvis, chest), nape = slerp(0.5, chest, face);
  pose.spine = inverse(pose.pelvis) * waist;
  pose.spine1 = inverse(waist) * chest;
  pose.neck = inverse(chest) * nape;
  pose.head = inverse(nape) * face;

  // Arms hang from the chest but keep to the plumb line: most of the chest's lean is taken back.
  const Quat plumb = slerp(0.7, Quat{}, axis_angle(x_axis, -style.lean));
  for (int side = 0; side < 2; ++side) {
    const double own = side == 0 ? cycles : cycles + 0.5;
    const double strength = wander(seed, 14 + side, cycles, 0.08) * (side == 1 ? 1 - 0.3 * limp : 1);
    BodyPose::Arm arm = arm_pose(style, own, strength);
    arm.arm = inverse(arm.shoulder) * plumb * arm.shoulder * arm.arm;
    if (side == 1) {
      arm = {mirrored(arm.shoulder), mirrored(arm.arm), mirrored(arm.fore_arm), mirrored(arm.hand)};
    }
    pose.arms[side] = arm;
  }
  return pose;
}

}  // namespace kinegraph
