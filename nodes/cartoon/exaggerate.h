// Exaggerates a motion by moving every joint away from its own average over time [Kwon §4]:
//   e = ω j + (1 − ω) a,  a = j ∗ gσ,
// on world positions. The printed Gaussian lacks its minus sign.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/cartoon/link_correction.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct ExaggerateParams {
  double omega = 5;             // 1 = the input
  double sigma = 0.12;          // of the Gaussian, s
  std::vector<double> weights;  // of each joint: ω_k = 1 + weight_k (ω − 1); empty = 1
  bool keep_root = false;       // the root's own path stays, the others are exaggerated relative to it
  bool correct = true;
  LinkCorrectionParams correction;
  double wished_stretch = 0;  // `auto`, above 1: chooses sigma and omega; 0 = off
};

struct ExaggerateResult {
  Motion motion;                // links that change length have translation tracks
  double omega = 1, sigma = 0;  // used
  LinkCorrectionResult correction;
  LinkStretch stretch;  // of the result's links against the input's
};

// What of a motion changes, as blended_change() takes it: chosen joints, and how much of the change at each
// frame.
struct MotionPart {
  std::vector<bool> joints;
  std::vector<double> weights;
};

// Joints that stand on their parent follow it; End Sites ride rigidly. Orientations: aim_links() of
// link_turns.h. With omega 1 the motion comes back bit for bit. `wished_stretch`: σ is a quarter of the
// dominant period, ω is found by bisection so that the 99th percentile of |w| / |v| is the wish, and the
// correction is left to do only what max_link asks, as it would take the wished stretch away again. Warns
// ("stretched-link") of a link over 3 times or under a third of its length, ("correction-unfinished") of
// goals not met, ("wish-unreached"). Where a `part` is given the motion changes there only, and lengths are
// told of what comes out.
ExaggerateResult exaggerate(const Motion& motion, const ExaggerateParams& params, Work& work,
                            const MotionPart* part = nullptr);

// The dominant period of a motion in seconds, by the autocorrelation of its joints' speeds about the root;
// the clip's length where nothing repeats.
double dominant_period(const WorldMotion& world, double fps);

}  // namespace kinegraph
