// FastICA from several starts: the most independent result, and whether it is the only one.
#pragma once
#include <cstdint>
#include <vector>

#include "graph/work.h"
#include "nodes/components/fast_ica.h"

namespace kinegraph {

struct BestStart {
  FastIcaRun run;            // `iterations`: of the rounds over all frames
  std::vector<bool> unique;  // of each component: whether nearly as independent optima have it too (optima.h)
};

// The run of the largest negentropy from `starts` starting rotations (fast_ica.h) and from what lies around
// the best of them. Of long clips (4,096 frames and more, and 128 a component) 2,048 frames, or 64 a
// component where that is more, are searched, one out of each of as many stretches; from what is found there
// FastICA goes on over all frames to the same tolerance. So the time grows with starts x 2,048 frames + 1 x
// all frames.
BestStart best_of_starts(const Rows& z, const FastIcaParams& params, int starts, std::uint64_t seed,
                         Work& work);

}  // namespace kinegraph
