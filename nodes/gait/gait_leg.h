// A leg of two bones that hangs straight down at rest: the one way its knee can bend to reach an ankle.
#pragma once
#include "nodes/motion/rotation.h"

namespace kinegraph {

struct LegPose {
  Quat thigh, shank;  // world orientations; at rest both point down -Y, knees ahead to +Z
};
// The knee lies in the plane of hip, ankle and the direction square to `across`, which points to the body's
// left. Lengths in metres; an ankle out of reach is aimed at with a straight leg.
LegPose reach_ankle(Vec3 hip, Vec3 ankle, double thigh, double shank, Vec3 across);

}  // namespace kinegraph
