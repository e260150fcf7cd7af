// Iterative motion warping on plain series [Hsu 2005 §4; Wu §4]: the path W over time and a smooth scale and
// offset a, b over frames, by turns, lower one energy.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/time/dynamic_time_warp.h"
#include "nodes/time/series.h"

namespace kinegraph {

struct MotionWarpSettings {
  WarpLimits limits;
  double scale_smoothness = 0;   // weight of F: larger = a varies less
  double offset_smoothness = 0;  // weight of G
  int iterations = 1;            // most rounds (a search for W, then a, b); at least 1
  double tolerance = 0;          // stop when max |Δa|, |Δb| is below it
  bool scale_and_offset = true;  // false: plain dynamic time warping, a = 1 and b = 0, one search
};

struct MotionWarpResult {
  WarpPath path;
  Series a, b;  // of the warped series' frames and dims
  // After the first search, then of what every half-step found: the last one's, too, which may bring nothing
  // and is then not taken.
  std::vector<double> energy;
  int rounds = 0;        // searches made
  bool settled = false;  // the path repeated or the change fell below the tolerance
};

// Lays `warped` (the shorter, S) on the clock of `clock` (the longer, r):
//   E = ‖W(S a + b) − r‖² + ‖F a‖² + ‖G b‖² + ε(‖a − 1‖² + ‖b‖²),   ε = 1e-9 × rows / frames,
// from a = 1, b = 0. E never rises. Throws as dynamic_time_warp.
MotionWarpResult iterative_motion_warp(const Series& warped, const Series& clock,
                                       const MotionWarpSettings& settings, Work& work);

}  // namespace kinegraph
