// World orientations of joints whose links have been moved: the smallest turn of what they were that aims
// their links anew, so that the twist about a link stays the input's.
#pragma once
#include <span>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The rotation that takes `from` nearest to `to` (least squares; Horn 1987), held a little towards no turn,
// so that links in one line, which leave a twist open, get the smallest turn. Equal lists: the identity.
Quat best_turn(std::span<const Vec3> from, std::span<const Vec3> to);

// For each joint the joints at the far ends of its links; where a child stands on the joint itself (links of
// less than 1e-6 of the height that never change), the child's own links count. A tip has none.
std::vector<std::vector<int>> links_below(const Motion& motion);
// One flag a joint: it stands on its parent, always.
std::vector<bool> on_parent(const Motion& motion);

// Orientations of a joint whose link went from old_from → old_to to from → to: the smallest turn of `old`
// that aims it, sign-continuous. Where the new link comes near the opposite of the old one its smallest turn
// spins: there the twist about the link departs from the input's by at most `most_twist` radians a frame
// (middle of the two nearest curves with that slope).
void aim_link(ConstVec3Track old_from, ConstVec3Track old_to, ConstVec3Track from, ConstVec3Track to,
              ConstQuatTrack old, double most_twist, QuatTrack out);
// Keeps the turn between `old` and `out` from changing by more than `most_turn` radians a frame, midway
// between following it forwards and backwards. Makes `out` sign-continuous.
void limit_turns(ConstQuatTrack old, double most_turn, QuatTrack out);
// Of a motion with that many frames a second.
double most_twist_at(double fps);

// Sets the orientations of `to` from those of `from` and both's positions (world, same joints and frames):
// one link below: aim_link(); several: best_turn(), with limit_turns(); a tip: as its own link turns.
// `ends[j]`: links_below().
void aim_links(const Skeleton& skeleton, const std::vector<std::vector<int>>& ends, const WorldMotion& from,
               double most_twist, WorldMotion& to, Work& work);

}  // namespace kinegraph
