// Ways through a skeleton's tree.
#pragma once
#include <vector>

#include "nodes/motion/skeleton.h"

namespace kinegraph {

// Joints from `top` (left out) down to `bottom`.
std::vector<int> chain_between(const Skeleton& skeleton, int top, int bottom);
int common_ancestor(const Skeleton& skeleton, int a, int b);
// Of a chain the two longest neighbouring links, as thigh and shin or upper arm and forearm are: the three
// joints of them and the one after, where there is one. Joints that lie on the one before don't count. Empty:
// there are no two links.
std::vector<int> longest_limb(const RestPose& pose, const std::vector<int>& chain);

}  // namespace kinegraph
