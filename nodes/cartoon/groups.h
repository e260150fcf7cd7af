// The chains of joints that bend like rubber [Kwon §5.2].
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "nodes/motion/skeleton.h"

namespace kinegraph {

// Fingers, thumbs and toe ends, by their names: one flag a joint, true also for all below one.
std::vector<bool> small_ends(const Skeleton& skeleton);

// A joint without children is in a group; a parent with exactly one child is in its child's group if the
// child is in one; so a group ends below the first branching joint, which isn't a member. Pruned joints don't
// count as children and are in none. Each group from its upper end down; in the order of their upper ends.
std::vector<std::vector<int>> automatic_groups(const Skeleton& skeleton, const std::vector<bool>& pruned);

// Groups from their first and last joints. Throws Failure ("unknown-joint", "bad-group") at `groups[i]`: the
// last must lie below the first, and no joint is in two groups.
std::vector<std::vector<int>> named_groups(const Skeleton& skeleton,
                                           const std::vector<std::pair<std::string, std::string>>& ends);

}  // namespace kinegraph
