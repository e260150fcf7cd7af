// What makes a walk a sneak or a strut: the numbers of each gait.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace kinegraph {

// Lengths in metres, angles in radians, phases as parts of the gait cycle (from one touch-down of a foot to
// its next), 0 = the left foot's touch-down. Amplitudes are half of the whole swing.
struct GaitStyle {
  std::string_view name, help;
  double cadence = 1.85;  // steps per second
  double stride = 0.72;   // a step's length

  // Feet.
  double duty = 0.605;      // part of the cycle that a foot is down; under 0.5 both are in the air at times
  double flat_from = 0.09;  // the sole lies flat between these phases of the foot's own cycle
  double flat_to = 0.36;
  double landing = 0.35;       // pitch at touch-down: > 0 heel first, < 0 ball first
  double push_off = 1.12;      // pitch at toe-off, heel up
  double swing_pitch = -0.05;  // pitch in the middle of the swing, toes up > 0
  double lift = -0.012;        // how much higher than straight across the ball swings
  double step_width = 0.12;    // between the ankles
  double toe_out = 0.1;
  double circle = 0.01;  // how far outwards the swinging foot goes round

  // Pelvis.
  double bob = 0.018;     // up and down, twice a cycle
  double bob_low = 0.03;  // phase where it is lowest
  double sway = 0.02;     // to the side of the foot that stands
  double surge = 0.008;   // to and fro, twice a cycle
  double turn = 0.1;      // about up, with the swinging leg
  double list = 0.06;     // the swinging side hangs
  double tilt = 0.06;     // forwards
  double reach = 0.991;   // the longest that a leg gets, as a part of its length
  double crouch = 0;      // how much lower than the legs allow, as a part of leg length

  // Trunk and head.
  double lean = 0.04;        // of the chest, forwards
  double chest_turn = 0.09;  // against the pelvis
  double chest_roll = 0.02;  // towards the foot that stands
  double nod = 0.01;         // of the chest, twice a cycle
  double head_pitch = 0.03;  // forwards
  double head_nod = 0;
  double look = 0;  // the head looks from side to side, once in four steps

  // Arms: forwards, outwards, bend.
  double arm_swing = 0.36;
  double arm_forward = 0.0;
  double arm_out = 0.13;
  double arm_out_swing = 0;  // further out as it swings forwards
  double arm_twist = 0.1;    // the upper arm turned inwards
  double elbow = 0.3;
  double elbow_swing = 0.18;
  double arm_lag = 0.03;  // phase by which the arm follows the opposite leg
  double pronate = 0.3;   // the forearm turned, thumbs inwards
  double wrist = -0.1;    // the hand bent towards the palm
  double shrug = 0;       // shoulders up
  double limp = 0;        // on the right leg, 0 to 1
};

const std::vector<GaitStyle>& gait_styles();         // the first is the default
const GaitStyle& gait_style(std::string_view name);  // throws Failure ("unknown-gait")

}  // namespace kinegraph
