// Step 4 of footskate cleanup [Kovar §3.4]: one leg, one frame. The leg swings about its hip towards the
// ankle's new place; its length is made up by the knee, damped to nothing near full extension where a small
// change of length would pop it, and by stretching thigh and shin alike, which leaves the knee's angle alone.
#pragma once
#include "nodes/motion/rotation.h"

namespace kinegraph {

// Of a leg bent otherwise and then stretched so that its ankle comes to a place. Metres.
struct LegReach {
  Vec3 along;            // from the new hip to the ankle's place, unit length
  double length = 0;     // from hip to ankle as it was
  double bent = 0;       // that after the knee took its share
  double wanted = 0;     // from the new hip to the ankle's place; 0 = the leg has no length or none is wanted
  double left_over = 1;  // of a small change of `wanted`, the part that the knee leaves to the stretch
};
// Hip, knee and ankle as they are; the new hip and ankle; all world metres. `damping`: the knee's flexion in
// radians, before or after the change, from which on it bends freely; at a third of it and under it keeps its
// angle.
LegReach leg_reach(Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 new_hip, Vec3 new_ankle, double damping);

struct LegChange {
  Quat thigh, shank;   // world, before the thigh's and the shank's own orientation
  double stretch = 1;  // of thigh and shin, with which the ankle meets its place
};
LegChange solve_leg(Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 new_hip, Vec3 new_ankle, double damping);

}  // namespace kinegraph
