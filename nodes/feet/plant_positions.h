// Step 1 of footskate cleanup [Kovar §3.1]: the place of each plant.
#pragma once
#include <optional>
#include <vector>

#include "nodes/feet/foot_track.h"

namespace kinegraph {

// Where heel and ball of one foot have to be, frame by frame; meaningful only in their planted frames.
struct PlantPositions {
  std::vector<Vec3> heel, ball;  // world, m
  std::vector<double> lift;      // m, from the middle of where the stand was up to its place
  std::vector<bool> steady;      // the foot stands well enough here: it is left as it is
};

// A plant is put in the middle of where its point was, so that the foot moves least. Plants of heel and ball
// that overlap or follow at once form one stand: the ball lies at the foot's own length from the heel, in the
// foot's mean direction. `floor`: the world height to put every plant on, keeping how far heel and ball
// usually stand above `contacts_floor`; without it each stand is put at the height that the contacts knew for
// it, or keeps its own.
PlantPositions plant_positions(const FootTrack& foot, double fps, std::optional<double> floor,
                               double contacts_floor);

}  // namespace kinegraph
