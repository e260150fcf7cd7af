// Laying two motions on one clock by iterative motion warping [Wu §4, Hsu 2005].
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"
#include "nodes/time/warp.h"

namespace kinegraph {

struct TimeWarpSettings {
  bool scale_and_offset = true;  // false: plain dynamic time warping
  std::string features = "*,root";
  bool per_dof = false;  // one path for each DOF instead of one for all
  // Weights of F and G. With w the scale and offset can follow changes over some 2πw frames, so 100 is five
  // strides at 120 frames a second: on CMU walks, runs and sneaks 10 to 30 let them take up the gait itself
  // (every path fits then, and legs come out of step), while above 300 slow differences of posture along the
  // way begin to steer the path again.
  double scale_smoothness = 100;
  double offset_smoothness = 100;
  std::size_t max_step = 0;  // 0: max(3, ⌈longer / shorter⌉ + 1)
  bool free_ends = false;
  int iterations = 20;           // CMU pairs settle in 6 to 18
  double tolerance = 1e-3;       // a thousandth of a joint's own spread
  std::vector<std::string> map;  // "FROM=TO": FROM a joint of the reference, TO one of the source
};

// The shared clock is the longer motion's; its motion is untouched (nothing here). The other is laid on it:
// each row shows the frame that the path names; the encoded root is carried like any DOF (a held frame
// repeats its deltas, a skipped one's are left out) and integrated from the place and heading of the first
// frame shown. Equal lengths: the source's clock.
struct TimeWarpResult {
  std::optional<Motion> warped;     // the source on the reference's clock
  std::optional<Motion> reference;  // the reference on the source's clock
  Warp warp;
};

// Motions of one rate. Throws Failure: "no-frames" at a port, "no-features" at features, "does-not-fit" at
// max_step, and those of partners() and chosen_joints(). Warns of joints without a partner, of ends left off,
// and when nothing moves.
TimeWarpResult time_warp(const Motion& source, const Motion& reference, const TimeWarpSettings& settings,
                         Work& work);

}  // namespace kinegraph
