// Step 3 of footskate cleanup [Kovar §3.3]: the root moves by as little as lets the legs reach. Solved for
// the whole clip at once as a smooth least-squares problem: frame by frame (the paper projects each hip onto
// its leg's sphere, then filters) the on and off of plants would jerk the body.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/feet/ankle_targets.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

struct RootAdjustmentParams {
  double smoothing = 0.08;     // s
  double knee_damping = 1.57;  // rad, as in leg_reach
};

// World translation of the root, frame by frame:
//   least Σ_t [ Σ_feet w e(r)² + c ‖r‖² ] + smoothing⁴ ‖r″‖²,
// e being what the leg must stretch by when the root is moved by r, the ankle by its own move, and the knee
// has taken its share; a planted leg's w grows with the part of the leg that e is, so that no leg stretches
// much where all can by a little. Solved by a few linear steps (Gauss-Newton).
std::vector<Vec3> root_adjustment(const WorldMotion& world, const std::vector<FootTrack>& feet,
                                  const std::vector<AnkleTargets>& targets, double fps,
                                  const RootAdjustmentParams& params, Work& work);

}  // namespace kinegraph
