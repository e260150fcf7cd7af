// How well feet stand: sliding while planted, and sinking into the floor.
#pragma once
#include <vector>

#include "nodes/judge/measured.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

struct FeetMeasures {
  // Mean horizontal speed of the planted points, m/s. A speed is taken between neighbouring frames of one
  // plant, so a point is never blamed for the step that brings it or takes it away.
  Measured skate;
  Measured skate_share;  // share of those frames at over 0.05 m/s
  Measured penetration;  // mean of max(0, floor − height) over all frames and points of feet, m
};

// Means over all points and frames together; of a joint: over the points that ride on it. `joints`: one flag
// a joint; only points on these count. Nothing where no plant lasts two frames (penetration: where there are
// no points).
FeetMeasures measure_feet(const WorldMotion& world, double fps, const Contacts& contacts,
                          const std::vector<bool>& joints, Window window);

}  // namespace kinegraph
