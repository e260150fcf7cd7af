// The chains of joints that pins bend.
#pragma once
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "graph/work.h"
#include "nodes/cartoon/turn_limits.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// Where a joint shall be, and how much of the way it goes there, at every frame.
struct Goal {
  std::vector<double> part;
  std::vector<Vec3> target;
};

// One chain, its pinned joints, and what lies below it.
struct PinnedChain {
  std::vector<int> joints;
  std::vector<std::pair<std::size_t, Goal>> goals;  // index into joints
};

// The joints at which chains end: where joints that aren't pruned part, or ways to pinned joints do.
std::vector<bool> chain_ends(const Skeleton& skeleton, const std::vector<bool>& pruned,
                             const std::set<int>& pinned);
// From the joint below the next of `ends` down to `joint`.
std::vector<int> chain_to(const Skeleton& skeleton, int joint, const std::vector<bool>& ends);

// Bends one chain of `moved`, in which the chains above it are bent already, through its goals. What hangs on
// it rides along; pinned joints keep their orientations.
void bend(const Skeleton& skeleton, const PinnedChain& chain, WorldMotion& moved, const TurnLimits& limits,
          Work& work);

}  // namespace kinegraph
