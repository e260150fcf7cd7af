// Feet that aren't planted stay above the floor: a restyled leg swings lower than the one its plants were
// found on. The ankle is lifted in free frames; what toes still lack, also in planted ones, their joint
// turns.
#pragma once
#include <optional>
#include <vector>

#include "nodes/feet/ankle_targets.h"
#include "nodes/feet/foot_track.h"
#include "nodes/motion/contacts.h"

namespace kinegraph {

// World heights, m, that the points of feet stay above.
struct FloorLimits {
  double heel, ball, tip;
};
// Balls and toes' tips: the contacts' floor, or the ground of their lowest plant where that is lower. Heels
// are ankle joints, with the sole far below: half-way between there and their usual height in plants. (A heel
// that strikes or a toe that pushes off comes by up to 4 cm under the height it has in stance, in captured
// walks.) `floor`: instead of the contacts' own.
FloorLimits floor_limits(const Contacts& contacts, std::optional<double> floor);

// Adds the least smooth lift to `move` in frames that aren't held. Within about 0.02 s of a plant, where a
// lift can't be smooth and large, some of the depth is left.
void lift_off_floor(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                    AnkleTargets& targets);

// World turns of the toe joint, on top of the ankle's, that bring the tip above its limit, by up to 45°;
// empty where none is needed.
std::vector<Quat> toe_turns(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                            const AnkleTargets& targets);

}  // namespace kinegraph
