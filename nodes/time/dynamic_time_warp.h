// Dynamic time warping with limited slopes: the monotone path that lays one series on another's clock at the
// least sum of squared differences [Hsu 2005 §4.2; Wu eq. 1, the step over W].
//
// Rows are the clock: every row names one frame of the series that is warped. From one row to the next the
// frame stays or advances by 1…max_step, and a frame is held for at most max_step rows in all. The search
// enforces both (its state is row, frame and run: how many rows the frame has been held), so the path is the
// best one there is within the limits.
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "graph/work.h"
#include "nodes/time/series.h"

namespace kinegraph {

struct WarpLimits {
  std::size_t max_step = 3;  // at least 1
  bool free_ends = false;    // false: first row shows the first frame, last row the last frame
                             // true: up to max_step frames may be left off at each end
};

// Entry r: the frame shown at row r.
using WarpPath = std::vector<std::uint32_t>;

// The least max_step with which `frames` frames can fill `rows` rows (frames <= rows): ⌈rows / frames⌉.
std::size_t least_max_step(std::size_t frames, std::size_t rows);
// The default: max(3, ⌈longer / shorter⌉ + 1).
std::size_t default_max_step(std::size_t frames, std::size_t rows);

// Where to look: within `radius` frames of `path`. The band widens where the result touches it, until it
// doesn't.
struct WarpBand {
  std::span<const std::uint32_t> path;  // one entry a row
  std::size_t radius = 0;
};

// argmin over paths of Σ_r ‖warped[path(r)] − clock[r]‖². The two have equal dims and warped.frames <=
// clock.frames; both have a frame. Ties: advance 1, then stay, then the smallest advance. Bit-identical on
// every CPU and number of threads. Time O(rows · frames · (dims + max_step)); memory 4 bits a cell that the
// limits let the path reach up to max_step 4, 8 up to 16, else 32. Throws Failure ("does-not-fit" at
// max_step, naming the least that works).
WarpPath dynamic_time_warp(const Series& warped, const Series& clock, const WarpLimits& limits, Work& work,
                           const WarpBand* band = nullptr);

// Σ_r ‖warped[path(r)] − clock[r]‖².
double path_cost(const Series& warped, const Series& clock, std::span<const std::uint32_t> path);

// Frames of a and b that correspond, one pair a row of the longer one's clock, in order of time. max_step 0:
// the default.
struct Correspondence {
  bool a_is_clock = false;  // true: pair i is (i, …)
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
};
Correspondence align(const Series& a, const Series& b, std::size_t max_step, bool free_ends, Work& work);

}  // namespace kinegraph
