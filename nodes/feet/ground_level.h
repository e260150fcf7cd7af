// A restyled body may stand in the floor: legs that another style straightens, at a height that stays the old
// one. Straight legs can't give way, so before its feet are held one by one the body is lifted to their
// ground as a whole, and a swinging foot with it. (A body that floats needs none of this: its legs reach
// down, and the root follows where they can't.)
#pragma once
#include <vector>

#include "nodes/feet/foot_track.h"
#include "nodes/feet/plant_positions.h"

namespace kinegraph {

// World metres by which to lift the whole body, frame by frame: h² / (h + 2 cm) where h > 0, since knees take
// what is small; h being over planted frames as near as can be to what each foot's stand lacks
// (PlantPositions::lift), and as even as can be,
//   least Σ_feet planted (h - lift)² + smoothing⁴ ‖h″‖².
// Empty: no stand lacks anything, as where the contacts were found on the motion itself.
std::vector<double> rise_to_ground(const std::vector<FootTrack>& feet,
                                   const std::vector<PlantPositions>& places, double fps);

}  // namespace kinegraph
