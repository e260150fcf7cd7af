// How far a motion is from another: frame by frame, after time warping, and in style.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/judge/measured.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"
#include "nodes/style/stats.h"

namespace kinegraph {

// Two motions and who stands for whom: `partner[j]` is the reference's joint for joint j of the motion, -1 =
// none or not asked for.
struct Compared {
  const Motion& motion;
  const WorldMotion& world;
  const Motion& reference;
  const WorldMotion& reference_world;
  std::vector<int> partner;
};

// Mean ‖p − p_ref‖, m, over the window's frames. Nothing where the frame counts differ.
Measured position_distance(const Compared& pair, Window window);
// Mean turn between the local rotations, degrees. Nothing where the frame counts differ.
Measured rotation_distance(const Compared& pair, Window window);
// Mean ‖p − p_ref‖, m, along the path of dynamic time warping that is best for it, with the root's place and
// heading taken out of every frame: R_y(−ψ)(p − p_root). The motion's window against the whole reference.
Measured aligned_distance(const Compared& pair, Window window, Work& work);

// Degrees: √(turn between the means² + (2 Δσ)²), σ being a half-angle, for joints where σ is over 0.06° in
// either; nothing for others and for joints of which either Stats knows nothing. `partner[j]`: the
// reference's joint for joint j of `stats`. Both in quaternion space.
Measured style_distance(const Stats& stats, const Stats& reference, const std::vector<int>& partner);

}  // namespace kinegraph
