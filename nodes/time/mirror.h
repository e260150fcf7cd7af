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
  // For a rest pose that is no mirror image of itself (local axes that differ from side to side, or a spine
  // along x): the turn, in rest world, that takes the ways from a joint to its children to the reflections of
  // its partner's ways. The identity for a symmetric one.
  std::vector<Quat> frames;
};
Vec3 reflected(Vec3 v, Vec3 across);
// M R M for the reflection M: the axis is reflected, and the turn goes the other way round.
Quat reflected(Quat q, Vec3 across);

// `pairs`: "LEFT=RIGHT" each; joints they don't name are paired by name (Left/Right, l/r), and where no name
// says anything, by the rest pose. Joints beside the middle without a partner are named in one warning
// ("no-mirror-partner"). Throws Failure ("bad-map", "unknown-joint") at pairs[i].
Sides find_sides(const Skeleton& skeleton, const std::vector<std::string>& pairs, Work& work);

// World space is reflected in the plane through its origin across Sides::across: what a joint turned and
// moved away from its rest pose, its partner turns and moves the other way round. Mirroring twice gives the
// motion back.
Motion mirrored(const Motion& motion, const Sides& sides, Work& work);

}  // namespace kinegraph
