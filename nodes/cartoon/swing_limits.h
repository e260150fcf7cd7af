// Keeps a link that swings off its place from flipping round between two frames, by no more than it needs.
#pragma once
#include <span>
#include <vector>

#include "nodes/motion/rotation.h"

namespace kinegraph {

// The angle by which the swing of a link turns from one frame to the next, apart from what the still link
// itself turns: that of (α ŷ), α the angle from the still link to the swung one and ŷ the direction across
// to which, carried along by the smallest turn of the still link. The swung link turns by no more than this
// and what the still one turns.
double swing_step(Vec3 still_before, Vec3 swung_before, Vec3 still, Vec3 swung);

// How fast the swing of a link may turn that itself may turn by `most`, where the still link turns by `own`:
// what is left, and at most half.
double swing_room(double most, double own);

// Whether a swung link of that length at rest points so far back that hold_swing() holds it.
bool points_back(Vec3 still, Vec3 swung, double rest);

// `still` and `swung`: a link, frame by frame, as it would be without its swing and with it. The swung link
// comes out such that it turns by at most `most[t]` radians from frame t − 1 to t, wherever the still one
// does; where that turns further, being too short to have a direction, there is no swing at that moment and
// less of it within `fade` frames. `rest`: its length at rest. What points back along the still link is
// squashed, not turned round; what turns too fast gets there in steps, half before and half after, and keeps
// its length. All of this moves by little more than the links that are given do.
std::vector<Vec3> hold_swing(std::span<const Vec3> still, std::span<const Vec3> swung,
                             std::span<const double> most, double rest, double fade);

}  // namespace kinegraph
