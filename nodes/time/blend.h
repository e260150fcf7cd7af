// Mixing two motions frame by frame [Shapiro §5.4].
#pragma once
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

// Each chosen joint with a partner goes from `motion` (weight 0) towards `other` (weight 1) by Slerp, and
// beyond; the root's position in a straight line, in world. `partner[j]`: the joint of `other` that belongs
// to joint j, or -1; `weights`: one a frame. Throws Failure ("too-short") when `other` ends before the last
// frame that has a weight.
Motion blended(const Motion& motion, const Motion& other, const std::vector<int>& partner,
               const std::vector<bool>& joints, const std::vector<double>& weights);

}  // namespace kinegraph
