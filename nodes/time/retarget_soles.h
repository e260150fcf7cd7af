// Feet of a mesh that would be under the ground, bent up.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/motion/character.h"
#include "nodes/time/standing_pose.h"

namespace kinegraph {

// A point of a mesh that rides on a foot's joint, in that joint's frame.
struct SolePoint {
  int joint = 0;
  Vec3 at;
};
// The outermost points, downwards and sideways, of what is bound to ankles and joints below.
std::vector<SolePoint> sole_points(const Character& character);

// Where such points are below `ground`, the foot is turned at its ankle, and then the toes at theirs, towards
// lying flat as in `stands`, by the least that brings them to it, or to lying flat. So toes of a shoe bend
// where the source's heel rises, however far they reach.
void keep_soles_up(const std::vector<Leg>& legs, const StandingPose& stands,
                   const std::vector<SolePoint>& points, double ground, Motion& motion, Work& work);

}  // namespace kinegraph
