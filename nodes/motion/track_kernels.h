// Rotations along time at the width of the CPU's vectors; results are the same at every width. Tracks of one
// call have the same number of frames; what is written may be one of the tracks that are read.
#pragma once
#include <cstddef>

#include "nodes/motion/motion.h"

namespace kinegraph {

// out = a b, or a⁻¹ b, of unit length; identity where the product is zero.
void multiply_tracks(ConstQuatTrack a, bool inverse_of_a, ConstQuatTrack b, QuatTrack out);

// The smallest turn from the direction from → to of one pair of tracks to that of the other, as
// smallest_turn().
void smallest_turns(ConstVec3Track old_from, ConstVec3Track old_to, ConstVec3Track from, ConstVec3Track to,
                    QuatTrack out);

// The first frame t, from `start` on (at least 1), at which |q_{t−1} · q_t| is below `least`; the number of
// frames if none.
std::size_t next_step_below(ConstQuatTrack track, double least, std::size_t start);

// The first frame, from `start` on (at least 1), into which the link between two points turns by an angle
// whose cosine is negative or its square under `cosine_squared`, while longer than √shortest_squared before
// and after.
std::size_t next_turn_beyond(ConstVec3Track from, ConstVec3Track to, double cosine_squared,
                             double shortest_squared, std::size_t start);

}  // namespace kinegraph
