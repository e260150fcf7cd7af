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

// Sets the orientations of `to` from those of `from` and both's positions (world, same joints and frames):
// one link below: the smallest turn that aims it; several: best_turn; a tip: the turn of its own link.
// `ends[j]`: links_below().
void aim_links(const Skeleton& skeleton, const std::vector<std::vector<int>>& ends, const WorldMotion& from,
               WorldMotion& to, Work& work);

}  // namespace kinegraph
