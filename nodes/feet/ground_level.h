// A restyled body may stand in the floor, or float: its legs are those of another style, its height is the
// old one. Before its feet are held one by one it is brought to its ground as a whole, so that a swinging
// foot goes with it, and what comes before the first plant and after the last one does too.
#pragma once
#include <vector>

#include "nodes/feet/ankle_targets.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

// World metres by which to lift the body, frame by frame: over planted frames as near as can be to what each
// foot asks for, and as even as can be,
//   least Σ_feet held (h - asked)² + smoothing⁴ ‖h″‖²,
// level before the first plant and after the last; of that h |h| / (|h| + 2 cm), since what is small is a
// matter of single steps. A foot that stands too low asks for its whole `lift` (PlantPositions::lift), as
// straight legs don't give way; one that stands too high for what the root goes down for it
// (root_adjustment.h), as legs reach down first. Empty: nothing is asked.
std::vector<double> rise_to_ground(const std::vector<AnkleTargets>& targets,
                                   const std::vector<std::vector<double>>& lifts,
                                   const std::vector<Vec3>& root, double fps);

}  // namespace kinegraph
