// Keeps links from flipping round between two frames.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

struct LinkFlipParams {
  double most_turn = 0;     // radians a frame that a link may always turn
  double times_input = 2;   // or that many times the turn of the same link in `from`
  double free_below = 0.2;  // of its rest length: shorter than that it may turn as it likes
  int softening = 0;        // rounds of averaging neighbouring frames' directions where a flip was spread
};

// A correction that makes squashed links grow again turns one that went through nothing round at once. Where
// a link of `moved` turns faster than it may, its direction goes there in steps, half before and half after,
// and at half that speed where it didn't turn faster itself; its length stays, and so do all other links:
// what lies below rides along. `lengths`: as link_lengths(). World positions, same joints and frames.
void hold_link_flips(const Skeleton& skeleton, const std::vector<double>& lengths, const WorldMotion& from,
                     const LinkFlipParams& params, WorldMotion& moved, Work& work);

}  // namespace kinegraph
