// Step 3 of footskate cleanup [Kovar §3.3]: the root moves by as little as lets the legs reach. Solved for
// the whole clip at once as a smooth least-squares problem: frame by frame (the paper projects each hip onto
// its leg's sphere, then filters) the on and off of plants would jerk the body.
#pragma once
#include <vector>

#include "nodes/feet/ankle_targets.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// World translation of the root, frame by frame. `smoothing` in seconds.
// Least Σ_t [ Σ_feet w (u · (m − r))² + c ‖r‖² ] + smoothing⁴ ‖r″‖²: u is the leg's direction, m the ankle's
// move, r the root's.
std::vector<Vec3> root_adjustment(const WorldMotion& world, const std::vector<FootTrack>& feet,
                                  const std::vector<AnkleTargets>& targets, double fps, double smoothing);

}  // namespace kinegraph
