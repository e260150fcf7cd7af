// Step 2 of footskate cleanup [Kovar §3.2]: ankle position and orientation that put the planted points on
// their places.
#pragma once
#include <vector>

#include "nodes/feet/foot_track.h"
#include "nodes/feet/plant_positions.h"

namespace kinegraph {

// What is added to one foot, frame by frame.
struct AnkleTargets {
  std::vector<Vec3> move;  // of the ankle, world, m
  std::vector<Quat> turn;  // world, before the ankle's own orientation
  std::vector<bool> held;  // heel or ball is planted: `move` is what the plant needs
};

// `turn` and `held`. Heel and ball planted: the foot turns so that both points aim along their places; else
// the turn is blended from such frames over `blend` seconds.
AnkleTargets ankle_turns(const FootTrack& foot, const PlantPositions& places, double fps, double blend);

// `move`: the ankle of a foot that is turned so moves until the planted points are met; else blended
// likewise.
void move_ankles(const FootTrack& foot, const PlantPositions& places, double fps, double blend,
                 AnkleTargets& targets);

}  // namespace kinegraph
