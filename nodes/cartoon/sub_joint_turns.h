// World orientations of sub-joints [Kwon §5.3].
#pragma once
#include <span>
#include <vector>

#include "graph/work.h"
#include "nodes/cartoon/sub_joints.h"
#include "nodes/cartoon/turn_limits.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// Half-angle vectors of a rotation through time. Each is that of the short way round, unless the rotation
// passes half a turn only for a moment: then it goes on beyond it, since changing to the other way round
// turns what lies between by up to a whole turn. Where the way does change, or the rotation jumps, the vector
// goes there by at most `most` (radians of full angle) a frame. `seconds`: of a frame.
std::vector<Vec3> followed_turns(std::span<const Quat> turns, double seconds, double most);

// Sets the orientations of `places`, whose positions are those of the sub-joints, from the joints' `world`
// before they moved. J′_{k,1}: aim_link(), or aim_branch(), from joint k's old link to its first new one.
// J′_{k,l}: the Slerp by (l − 1)/m_k from it to the child's first, both as they are turned from the joints'
// rest poses (so that it doesn't depend on how a rig's frames stand), the turn between them as
// followed_turns(), its twist about its own sub-link held to `limits`. `ends`: links_below() of the joints.
// `axes`: each sub-joint's link at rest in its own frame; empty: they aren't held (one frame needs no limit).
void turn_sub_joints(const Skeleton& skeleton, const SubJoints& sub,
                     const std::vector<std::vector<int>>& ends, const WorldMotion& world, double fps,
                     const std::vector<Vec3>& axes, WorldMotion& places, Work& work);

}  // namespace kinegraph
