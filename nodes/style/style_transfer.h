// Gives a motion the style of another [Wu §5]: each joint's rotations get the reference's mean and spread,
// and so do the root's travel and height.
#pragma once
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"
#include "nodes/style/quat_stats.h"
#include "nodes/style/stats.h"

namespace kinegraph {

enum class TransferredPart { both, mean, spread };
enum class TransferredRoot { both, travel, height, none };
enum class TravelKind { feet, printed };
enum class HeadingKind { keep, transfer };

struct StyleTransferParams {
  StyleSpace space = StyleSpace::quaternion;  // quaternion: eq. 7; euler: eq. 5
  TransferredPart transfer = TransferredPart::both;
  TransferredRoot root = TransferredRoot::both;
  TravelKind travel = TravelKind::feet;
  HeadingKind heading = HeadingKind::keep;
  double max_gain = 0;           // bound of σr/σs; 0 = none
  std::vector<bool> joints;      // of the motion; empty = all. The root's path follows the root joint's flag
  std::vector<double> weights;   // of the change at each frame; empty = 1 everywhere
  std::vector<std::string> map;  // "FROM=TO": FROM of the style, TO of the motion
};

struct JointGain {
  int joint = 0;
  double gain = 1;  // σr/σs as applied
  double largest_turn =
      0;  // of the motion from its own mean, rad; gain × this is the largest turn of the result
  std::size_t frame = 0;  // where that is
  bool bounded = false;   // by max_gain
};
struct StyleTransferResult {
  Motion motion;
  double travel_factor = 1;      // by which `feet` multiplied the travel
  std::vector<JointGain> gains;  // of the joints that were changed, in quaternion space
};

// Travel `printed` is eq. 4's: the reference's speed, under legs that keep the source's cadence, and its
// sideways drift, which with the heading kept leads a walk up to 50° off its way (CMU 16_31 ← 104), as it
// tells how the reference's pelvis stands to its path. `feet` is the motion's own d_x and d_z times the one
// factor that makes its planted feet, in their new pose, slide least: the direction of travel stays the
// motion's, and the steps' rhythm fits its legs. (Eq. 4's d times a factor slides twice as much on all four
// pairs of Wu's Table 1: its spread, magnified with the mean, has nothing to do with the source's steps.) The
// factor is found at full strength, before `weights`.
//
// `own`: the motion's own statistics; null: measured here with the style's settings. Joints that `style`
// doesn't hold keep their motion. Frame rates may differ: travel is per second. Throws Failure:
// "space-mismatch" (Stats of another space than params.space), "euler-order-mismatch", "unknown-joint",
// "bad-map", "no-frames". Warns: "fold-over" (gain × largest turn reaches 170°; past 180° the sphere wraps),
// "no-plants", "no-partner", "rest-pose-differs". Info: "gain-bounded", "travel-factor".
StyleTransferResult style_transfer(const Motion& motion, const Stats& style, const Stats* own,
                                   const StyleTransferParams& params, Work& work);

}  // namespace kinegraph
