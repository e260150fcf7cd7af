// Pulls links that exaggeration has stretched or squashed back towards their lengths [Kwon, Fig. 4].
#pragma once
#include <cstddef>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// Of the links between joints and their parents over all frames. Links that stand on their parent don't
// count.
struct LinkStretch {
  double largest = 1;                           // |w| / |v|
  double smallest = 1;                          // |w| / |v|
  int largest_joint = -1, smallest_joint = -1;  // at the link's lower end; -1: no link
  std::size_t largest_frame = 0, smallest_frame = 0;
  // The larger of stretch and squash, as a factor above 1.
  double worst() const { return largest * smallest > 1 ? largest : 1 / smallest; }
};
// `lengths`: |v| of each joint's link at each frame, joint * frames + frame; 0 = no link.
// `only`: of that joint's link alone, where not negative.
LinkStretch link_stretch(const Skeleton& skeleton, const std::vector<double>& lengths,
                         const WorldMotion& moved, int only = -1);

// |v| of every link: joint * frames + frame; 0 for the root and for joints that stand on their parent.
std::vector<double> link_lengths(const Skeleton& skeleton, const std::vector<bool>& on_parent,
                                 const WorldMotion& world);

struct LinkCorrectionParams {
  double delta = 0.5;    // part of a link's violation that is taken away at once, in (0, 0.5]
  double error = 0.03;   // goal: mean over frames of Σ| |w| − |v| | / Σ|v|
  double max_link = 0;   // further goal: no |w| / |v| above this; 0 = none
  int iterations = 100;  // at most
};
struct LinkCorrectionResult {
  int iterations = 0;
  double error = 0;  // of what is left
  double error_before = 0;
  double delta = 0;  // the smallest that was used
  bool met = false;  // both goals
};

// Moves the joints of `moved` (world, m). In every iteration each link's lower joint goes by
//   δ (|w| − |v|) w / |w|,  w = e_p − e_c,
// all from the same positions; descendants don't ride along; squashed links grow; at |w| = 0 nothing moves.
// The printed Fig. 4 has |v| alone for the length of the step, which never shrinks the error; meant is the
// violation. An iteration that raises the error halves δ (to a sixteenth at the least), one that lowers it
// doubles it again up to `delta`. What comes out is the best of all, or the first that meets both goals.
LinkCorrectionResult correct_links(const Skeleton& skeleton, const std::vector<bool>& on_parent,
                                   const std::vector<double>& lengths, const LinkCorrectionParams& params,
                                   WorldMotion& moved, Work& work);

}  // namespace kinegraph
