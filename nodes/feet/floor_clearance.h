// Feet that aren't planted stay above the floor: a restyled leg swings lower than the one its plants were
// found on. The ankle is lifted in free frames; what toes still lack, also in planted ones, their joint
// turns.
#pragma once
#include <optional>
#include <vector>

#include "nodes/feet/ankle_targets.h"
#include "nodes/feet/foot_track.h"
#include "nodes/feet/plant_positions.h"
#include "nodes/motion/contacts.h"

namespace kinegraph {

// World heights, m, that the points of one foot stay above, frame by frame.
struct FloorLimits {
  std::vector<double> heel, ball;
  double tip = 0;
};
// Toes' tips: the contacts' floor, or the ground of their lowest plant where that is lower. Heels are ankle
// joints, with the sole far below, and balls have some of it below them: a swinging foot passes above the
// lowest place where that part of it stands, less 5 mm. Beside the foot's plants, and before the first and
// after the last, less 22 mm, by which heels that strike and toes that push off go deeper in captured walks
// and runs. Never lower than the tips' limit, for heels half-way from there to their usual height; no higher
// than that before a foot's first plant and after its last where its plants lie 6 cm apart or more: on slopes
// and stairs. `floor`: instead of the contacts' own.
FloorLimits floor_limits(const Contacts& contacts, const FootTrack& foot, std::optional<double> floor);

// A foot that only its ball holds turns about it, by up to 30°, where its heel
// would pass through the floor.
void raise_heels(const FootTrack& foot, const PlantPositions& places, const FloorLimits& limits, double fps,
                 double blend, AnkleTargets& targets);

// Adds the least smooth lift to `move` in frames that aren't held. Within about 0.02 s of a plant, where a
// lift can't be smooth and large, some of the depth is left. `weights`: the part of the change made at each
// frame, 0 to 1.
void lift_off_floor(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                    const std::vector<double>& weights, AnkleTargets& targets);

// Where legs don't bend as far as a lift asks, the foot turns up instead, by up to 30°, in frames that aren't
// held: balls of `foot` above their limit. `move` is where the leg brings the ankle.
void raise_balls(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                 const std::vector<double>& weights, AnkleTargets& targets);

// World turns of the toe joint, on top of the ankle's, that bring the tip above its limit, by up to 45°;
// empty where none is needed.
std::vector<Quat> toe_turns(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                            const AnkleTargets& targets);

}  // namespace kinegraph
