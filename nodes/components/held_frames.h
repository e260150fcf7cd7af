// A clip that TimeWarp laid on a longer clock holds its frames, and plays slower there than it will once
// UnwarpTime has put it back: how much slower tells what a frequency on that clock is worth in its own time.
#pragma once
#include <cstddef>

#include "nodes/components/rows.h"

namespace kinegraph {

// Rows of `signals` (components by frames) that repeat the one before, within 1e-9 of unit variance, are
// held. Out: frames that are shown by frames there are, in (0, 1]. Where a clip stands still for longer than
// `longest` frames it holds nothing: those frames don't count.
double own_share_of_frames(const Rows& signals, std::size_t longest);

}  // namespace kinegraph
