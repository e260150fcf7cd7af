// Rotation channels in degrees to quaternions, a whole time series at once.
#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

// The rotation of `axes` ("ZYX": R = Rz Ry Rx; any number of axes, also repeated) at each frame. `degrees[i]`
// is the series of axis i, each as long as the tracks of `out`; |angle| up to 1e9. Signs are left as the
// half-angles give them. Angles are reduced in degrees, where that is exact, so that 190 and -170 give the
// same rotation to the last bit or two. The same bits on every CPU: only + - * in a fixed order, on as many
// lanes as the machine has.
void rotations_from_degrees(std::string_view axes, std::span<const double* const> degrees, QuatTrack out);

// q <- C q C⁻¹ at each frame.
void conjugate_by(Quat c, QuatTrack q);

// Flips signs so that neighbours have a non-negative dot product: as make_continuous, fast where nothing has
// to flip.
void make_track_continuous(QuatTrack q);

// Largest |value|; a NaN counts as infinite.
double largest_size(std::span<const double> values);

// Whether the rotations of `axes` and `degrees` are those of `q`, up to sign, within 1e-11 in every
// component. Tells that channels as read still say what a track holds. One flag a frame in `same` where they
// aren't all; returns whether they all are. `scratch` has as many frames as q.
bool same_rotations(std::string_view axes, std::span<const double* const> degrees, ConstQuatTrack q,
                    QuatTrack scratch, std::vector<char>& same);

}  // namespace kinegraph
