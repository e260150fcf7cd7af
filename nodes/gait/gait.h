// A source of motion that needs no file: people who walk, run, sneak, hobble, strut… straight ahead along +Z
// from the origin, in a steady rhythm, on feet that plant exactly.
#pragma once
#include <cstdint>
#include <string>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct GaitParams {
  std::string gait = "walk";
  double speed = 0;      // m/s; 0 = the gait's own, as for the next two
  double cadence = 0;    // steps a second
  double stride = 0;     // metres a step; speed = cadence * stride, so at most two may be given
  double bounce = 1;     // times the gait's own rise and fall
  double lean = 0;       // degrees further forwards
  double crouch = 0;     // part of the leg's length by which the pelvis is lower
  double arm_swing = 1;  // times the gait's own
  double limp = 0;       // on the right leg, 0 to 1, beside the gait's own
  double seconds = 4;
  double fps = 120;
  std::uint64_t seed = 0;  // 0 = every step alike; others vary steps, arms and head a little
};

// Speed, cadence and stride after those that are given; with one given, stride / cadence stays the gait's
// own, as it does in people. Throws Failure ("gait-overdetermined") when all three are.
struct Pace {
  double speed, cadence, stride;
};
Pace resolved_pace(const GaitParams& params);

// Throws Failure ("unknown-gait", "gait-overdetermined", "gait-out-of-reach") with what to change.
Motion make_gait(const GaitParams& params, Work& work);

}  // namespace kinegraph
