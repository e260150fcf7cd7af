// One leg through the whole clip, solved frame by frame (leg_solver.h) and stretched smoothly.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/feet/ankle_targets.h"
#include "nodes/feet/foot_track.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

struct SolvedLeg {
  std::vector<Quat> thigh, shank;  // world, before the thigh's and the shank's own orientation
  std::vector<Vec3> stretch;       // .x: of thigh and shin, as a part of their length
  std::vector<Vec3> ankle_move;    // world, m: where the ankle comes to
  std::vector<double> residual;    // m, that the largest stretch leaves to the ankle's target
};

struct LegLimits {
  double stretch;  // most, as a part of the leg's length
  double damping;  // rad, as in leg_reach
};

// `root`: by how much the root moves. A held foot's leg stretches as it must; a swinging foot has no place to
// meet, so its leg goes back to its length within `fade` seconds, and may come short of its target.
SolvedLeg solved_leg(const WorldMotion& world, const FootTrack& foot, const AnkleTargets& targets,
                     const std::vector<Vec3>& root, const LegLimits& limits, double fps, double fade,
                     Work& work);

}  // namespace kinegraph
