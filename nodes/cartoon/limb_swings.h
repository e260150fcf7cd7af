// What springs add to the sub-joints, without flipping their links round between two frames.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/cartoon/sub_joint_flips.h"
#include "nodes/cartoon/sub_joints.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// Adds swings to `places`: swing[frame * sub-joints + i], of which left[i][frame] is taken (empty: all).
// What stands on the joint above swings with it.
// A link that would flip swings less far off its own place or gets there more slowly, as hold_swing(); what
// lies below rides along. Where a planted point's `left` holds it, the limb above shares out among its links
// what that takes from one of them. A limb that flips for all that swings less for a moment, down to hanging
// stiffly on the joint it branches off from; one that still flips then, together with the one it hangs on.
void add_swings(const SubJoints& sub, const FlipWatch& watch, std::vector<Vec3> swing,
                const std::vector<std::vector<double>>& left, double fps, WorldMotion& places, Work& work);

}  // namespace kinegraph
