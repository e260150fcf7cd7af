// Links that are cut into several, as RubberJoints leaves them: NAME, NAME_2, NAME_3, … down to the next
// joint.
#pragma once
#include <string>
#include <vector>

#include "nodes/motion/skeleton.h"

namespace kinegraph {

// One flag a joint: it lies on a cut link, below the joint that the link starts at. Files keep nothing of
// that but the tree and the names, so both must agree: its parent is the one before it by name (NAME_2 below
// NAME, NAME_3 below NAME_2), and it has exactly one child.
std::vector<bool> on_cut_links(const Skeleton& skeleton);

// The nearest joint above that isn't on a cut link; -1 above the root. `cut`: on_cut_links().
int whole_parent(const Skeleton& skeleton, const std::vector<bool>& cut, int joint);

}  // namespace kinegraph
