// Step 4 of footskate cleanup [Kovar §3.4]: one leg, one frame. The leg swings about its hip towards the
// ankle's new place; its length is made up by the knee, damped to nothing near full extension where a small
// change of length would pop it, and by stretching thigh and shin alike, which leaves the knee's angle alone.
#pragma once
#include "nodes/motion/rotation.h"

namespace kinegraph {

struct LegChange {
  Quat thigh, shank;    // world, before the thigh's and the shank's own orientation
  double stretch = 1;   // of thigh and shin
  double residual = 0;  // m, how far the ankle stays from its place
};
// Hip, knee and ankle as they are; the new hip and ankle; all world metres. `most` is the largest |stretch -
// 1|. `damping`: the knee's flexion in radians from which on it bends freely; at a third of it and under it
// keeps its angle.
LegChange solve_leg(Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 new_hip, Vec3 new_ankle, double most,
                    double damping);

}  // namespace kinegraph
