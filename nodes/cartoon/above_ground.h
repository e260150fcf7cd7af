// How far feet must be lifted that an exaggerated swing takes under the ground.
#pragma once
#include <vector>

#include "nodes/motion/contacts.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// For each frame, metres up, 0 where the point (on `joint` of the motion) is above the ground: the height at
// which it was last planted, or next is, if that is lower. What is d below it comes up by d² / (d + m), so
// that it slides into the lift and stays under the ground by less than m = 2.5 % of the legs' length `leg`.
// In planted frames, and for points that have no heights, 0.
std::vector<double> lift_above_ground(const FootPoint& point, const WorldMotion& world, int joint,
                                      double leg);

}  // namespace kinegraph
