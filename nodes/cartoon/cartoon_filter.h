// Two other ways to exaggerate, for comparison with Exaggerate [Kwon, Fig. 14].
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct LogFilterParams {
  double strength = 2;        // A
  double sigma = 0.12;        // s
  bool on_positions = false;  // else on angles: local rotations and the root's path
};
// x − A σ² (x ∗ g″σ), the inverted Laplacian of a Gaussian [Wang 2006]: anticipation and overshoot where a
// motion starts and stops. g″ is sampled at the frames, cut at ⌈6 σ⌉ (at most N − 1) frames each side,
// continued by odd reflection, and made to give exactly 0 on uniform motion and 2 on t². On angles: rotation
// by rotation in the tangent space of the frame itself, Σ_k w_k 2 log(q_t⁻¹ q_{t+k}), which needs no mean and
// doesn't wrap. On positions: world positions of joints; links stretch. For slow motion Exaggerate equals it
// on positions with A = (ω − 1)/2.
Motion log_filter(const Motion& motion, const LogFilterParams& params, Work& work);

struct MultiresolutionParams {
  std::vector<double> gains{1.6, 1.6, 1.3};  // of each band, finest first; 1 = as it is
  double sigma = 0.05;                       // of the finest Gaussian, s; doubled from band to band
};
// Coarser and coarser by quaternion Gaussians (a weighted sum of sign-continuous quaternions, brought to
// length 1), with details log(coarse⁻¹ fine); put together again with a gain for each band [Lee & Shin 2001].
// The root's translation likewise.
Motion multiresolution_filter(const Motion& motion, const MultiresolutionParams& params, Work& work);

}  // namespace kinegraph
