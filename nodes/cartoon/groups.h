// The chains of joints that bend like rubber [Kwon §5.2].
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "nodes/motion/skeleton.h"

namespace kinegraph {

// Fingers, thumbs, toe ends and single toes (several below one joint), by their names: one flag a joint, true
// also for all below one. Nor are those bones a limb's own that stand beside it to share its twist or the
// skin of its bend and lead to nothing else: [Kwon] has no such bones, and with them as branches thighs and
// arms of Character Creator's bodies would be in no group.
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
