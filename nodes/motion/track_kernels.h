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

// out = a b, or a⁻¹ b: the very numbers that operator* gives.
void compose_tracks(ConstQuatTrack a, bool inverse_of_a, ConstQuatTrack b, QuatTrack out);

// out = start + rotate(turn, link): the very numbers that rotate() gives.
void hang_tracks(ConstVec3Track start, ConstQuatTrack turn, ConstVec3Track link, Vec3Track out);

// The smallest turn of `base` that aims what stands along `rest` from `from` to `to`: smallest_turn() from
// rotate(base, rest) to the link, times base, in the half-angle's form. `rest_length` is that of `rest`. From
// frame `start` on, up to the first that takes more care, because the link is shorter than 1e-9 m or turns by
// more than about 151°; gives that frame, where `out` is undefined, or the number of frames.
std::size_t aim_tracks(ConstQuatTrack base, Vec3 rest, double rest_length, ConstVec3Track from,
                       ConstVec3Track to, QuatTrack out, std::size_t start);

// The first frame t, from `start` on (at least 1), at which |q_{t−1} · q_t| is below `least`; the number of
// frames if none.
std::size_t next_step_below(ConstQuatTrack track, double least, std::size_t start);

// The first frame, from `start` on (at least 1), into which the link between two points turns by an angle
// whose cosine is negative or its square under `cosine_squared`, while longer than √shortest_squared before
// and after.
std::size_t next_turn_beyond(ConstVec3Track from, ConstVec3Track to, double cosine_squared,
                             double shortest_squared, std::size_t start);

}  // namespace kinegraph
