// A motion at another rate.
#pragma once
#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// Frame i of the result lies at i / fps seconds; as many frames as fit in the motion's length (its last frame
// included). Rotations by Slerp, translations by the cubic through the neighbouring frames (Catmull-Rom). The
// motion itself when it has that rate.
Motion resampled(const Motion& motion, double fps, Work& work);

}  // namespace kinegraph
