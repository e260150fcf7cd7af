// Where one foot of a gait is at any time: it lands, rolls to flat, rolls off over the ball and swings to the
// next print. While heel or ball is down, that point of the foot does not move at all; between, ankle, pitch
// and toes are quintics that join in value, speed and acceleration.
#pragma once
#include <cstdint>

#include "nodes/gait/gait_skeleton.h"
#include "nodes/gait/gait_styles.h"
#include "nodes/gait/quintic.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

// World: x to the left, y up, z ahead. Seconds, metres, radians.
struct FootState {
  Vec3 ankle;
  double pitch = 0;                           // of the sole, toes up > 0
  double yaw = 0;                             // about up; left > 0
  double toe_bend = 0;                        // of the toes against the sole, up > 0
  bool heel_down = false, ball_down = false;  // the rolled point rests on its print
};

struct FootTiming {
  double period = 1;       // s, of a cycle
  double speed = 1;        // m/s, of the body
  double start = 0;        // s, of a touch-down
  double lead = 0;         // m, of the print before the pelvis at touch-down
  std::uint64_t seed = 0;  // 0 = every step alike
};

class GaitFoot {
 public:
  GaitFoot(const GaitStyle& style, const GaitBody& body, bool left, const FootTiming& timing);
  FootState at(double seconds) const;
  Quat orientation(const FootState& state) const;  // of the foot, world

 private:
  struct Rolled {
    CoordinateState up, ahead;  // from where it is when the sole lies flat
  };
  Rolled ball_from_flat(const CoordinateState& pitch) const;
  Vec3 rolled(double pitch) const;
  CoordinateState stance_pitch(double since_landing) const;
  Vec3 print(std::int64_t step) const;  // of the ankle when the sole lies flat
  FootState swinging(std::int64_t step, double since_landing) const;

  GaitStyle style_;
  GaitBody body_;
  FootTiming timing_;
  bool left_;
  double flat_from_, flat_to_, lift_off_;  // s after landing
  double landing_rate_, push_off_rate_;    // rad/s
};

// A number in [-1, 1] that depends only on its arguments; 0 for seed 0.
double variation(std::uint64_t seed, std::uint64_t channel, std::int64_t index);

}  // namespace kinegraph
