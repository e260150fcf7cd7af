// A motion with left and right exchanged.
#pragma once
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// Which joint each joint changes places with (itself in the middle), and the plane of the skeleton that
// divides its sides.
struct Sides {
  std::vector<int> partner;  // an involution
  Vec3 across{1, 0, 0};  // unit, horizontal, world: from the right side to the left; the plane is across it
};

// `pairs`: "LEFT=RIGHT" each; joints they don't name are paired by name (Left/Right, l/r), and where no name
// says anything, by the rest pose. Joints beside the middle without a partner are named in one warning
// ("no-mirror-partner"). Throws Failure ("bad-map", "unknown-joint") at pairs[i].
Sides find_sides(const Skeleton& skeleton, const std::vector<std::string>& pairs, Work& work);

// World space is reflected in the plane through its origin across Sides::across: what a joint turned and
// moved away from its rest pose, its partner turns and moves the other way round. Mirroring twice gives the
// motion back.
Motion mirrored(const Motion& motion, const Sides& sides, Work& work);

}  // namespace kinegraph
