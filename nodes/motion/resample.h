// The same motion at another frame rate.
#pragma once
#include "graph/work.h"
#include "nodes/motion/motion.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// Rotations by Slerp between neighbouring frames, translations by a cubic through four (Catmull-Rom, C1). A
// sample at the time of a frame is that frame, bit for bit. Samples lie at k / fps seconds from frame 0 on,
// as far as the last frame. Rates within 0.005 % of a whole number count as it: 1/0.008333 is 120. Nothing is
// filtered before frames are left out. fps > 0.
Motion resampled(const Motion& motion, double fps, Work& work);
// Likewise. A sample beside a missing one is missing, but at the time of a frame; where only a farther
// neighbour is missing, the parabola or line through those that are there goes on.
Points resampled(const Points& points, double fps, Work& work);

}  // namespace kinegraph
