// World orientations of joints whose links have been moved: the smallest turn of what they were that aims
// their links anew, so that the twist about a link stays the input's.
#pragma once
#include <span>
#include <vector>

#include "graph/work.h"
#include "nodes/cartoon/turn_limits.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The rotation that takes `from` nearest to `to` (least squares; Horn 1987), held a little towards no turn,
// so that links in one line, which leave a twist open, get the smallest turn. Equal lists: the identity.
Quat best_turn(std::span<const Vec3> from, std::span<const Vec3> to);

// For each joint the joints at the far ends of its links; where a child stands on the joint itself (links of
// less than 1e-5 of the height that never change), the child's own links count. A tip has none.
std::vector<std::vector<int>> links_below(const Motion& motion);
// One flag a joint: it stands on its parent, always.
std::vector<bool> on_parent(const Motion& motion);

// Direction of the link between two joints at rest, in the frame of joint `of`; zero where they meet.
Vec3 rest_link(const RestPose& rest, int of, int from, int to);

// Orientations of a joint whose link went from old_from → old_to to from → to: the smallest turn of `old`
// that aims it, sign-continuous. Where the new link comes near the opposite of the old one its smallest turn
// spins, and where it comes near nothing its direction jumps: there turn and twist are held to `limits`.
// `axis`: rest_link().
void aim_link(Vec3 axis, ConstVec3Track old_from, ConstVec3Track old_to, ConstVec3Track from,
              ConstVec3Track to, ConstQuatTrack old, const TurnLimits& limits, QuatTrack out);
// Of a joint with several links, or none: best_turn() of `old`, held to limits.twist_departure, and to less
// where the input twists so much that its twist and that would exceed limits.twist.
void aim_branch(std::span<const Vec3> axes, ConstVec3Track old_at, std::span<const ConstVec3Track> old_ends,
                ConstVec3Track at, std::span<const ConstVec3Track> ends, ConstQuatTrack old,
                const TurnLimits& limits, QuatTrack out);

// Sets the orientations of `to` from those of `from` and both's positions (world, same joints and frames):
// one link below: aim_link(); several: aim_branch(); a tip: as its own link turns.
// `ends[j]`: links_below().
void aim_links(const Skeleton& skeleton, const std::vector<std::vector<int>>& ends, const WorldMotion& from,
               const TurnLimits& limits, WorldMotion& to, Work& work);

}  // namespace kinegraph
