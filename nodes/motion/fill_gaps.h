// Missing markers over short gaps.
#pragma once
#include "nodes/motion/points.h"

namespace kinegraph {

// Fills gaps of up to `max_gap` frames that have samples on both sides, each by the natural cubic spline
// through the nearest samples (up to eight on each side, none farther than another gap longer than
// `max_gap`). Longer gaps and those at an end stay missing. Returns how many samples were filled; the mask
// goes when none is missing.
std::size_t fill_gaps(Points& points, std::size_t max_gap);

// Where a label is missing: runs of frames, half-open.
struct Gap {
  std::size_t first, last;
};
std::vector<Gap> gaps_of(const Points& points, int label);

}  // namespace kinegraph
