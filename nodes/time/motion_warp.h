// Motion warping [Witkin & Popović 1995]: a few poses are changed, and smooth displacement curves carry the
// change through the rest, so that the fine detail of the motion stays.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// At `frame` the joint has this local rotation (as a Motion holds it) or this world position (m). With
// neither it stays as it is there: an anchor, which keeps a change from spreading further.
struct WarpKey {
  std::int64_t frame = 0;
  std::string joint;
  std::optional<Quat> rotation;
  std::optional<Vec3> position;
};

// Each changed channel is displaced by a C² cubic spline through the wanted differences: half-angle logs on
// the parent's side for rotations, metres for the root's position. Nothing moves at the first and last frame
// unless a key says so. A position below the root is reached by the two joints of its limb that can move it
// farthest, as in a knee and a hip: the middle one bends in its own plane, the upper one makes the smallest
// turn that aims it; bones keep their lengths. Exact at every key within 1e-6 m and rounding. Throws Failure
// at keys[i]: "bad-frame", "unknown-joint", "bad-key", "duplicate-key", "no-limb", "out-of-reach",
// "keys-conflict".
Motion motion_warp(const Motion& motion, const std::vector<WarpKey>& keys, Work& work);

}  // namespace kinegraph
