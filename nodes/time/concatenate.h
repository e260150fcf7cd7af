// One motion after the other.
#pragma once
#include <span>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct ConcatenateSettings {
  bool align_root = true;  // each motion goes on from where, and facing where, the one before ends
  double blend = 0;        // seconds over which neighbours overlap and fade into each other
};

// Motions of the same joints by name and rate; skeleton, bone lengths and source facts are the first's. Two
// motions of m and n frames that overlap by k make m + n - k. Aligned, a motion is turned about up and moved
// along the ground: with an overlap so that both roots meet in its middle, without one so that its first
// frame lies one step of travel past the last. Throws Failure at port motions: "different-joints" naming the
// joint, "rate-mismatch", "too-short" for the overlap.
Motion concatenated(const std::vector<const Motion*>& motions, const ConcatenateSettings& settings,
                    Work& work);

}  // namespace kinegraph
