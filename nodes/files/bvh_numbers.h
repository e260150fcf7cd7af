// The numbers of a BVH's MOTION section.
#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include "graph/work.h"

namespace kinegraph {

struct BvhNumbers {
  // Channel after channel, `kept` values each: the frames [first, first + kept) of the file.
  std::shared_ptr<std::vector<double>> series;
  std::vector<double> first_frame;  // the file's frame 0, kept or not; empty where it has none
};

// Reads `frames` frames of `channels` numbers from `from` on, and keeps those of [first, last). A frame is a
// line, or several that together hold exactly its numbers. Numbers run together at a minus sign are split,
// with a warning
// ("glued-numbers"); data after the announced frames is left out with a warning ("more-frames"). Throws
// Failure with line and column: "too-few-values", "too-many-values", "too-few-frames", "decimal-comma",
// "not-finite", "bad-number".
BvhNumbers read_bvh_numbers(std::string_view text, const char* from, std::size_t channels, std::size_t frames,
                            std::size_t first, std::size_t last, Work& work);

}  // namespace kinegraph
