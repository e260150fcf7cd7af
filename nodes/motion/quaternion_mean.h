// Mean and spread of a set of rotations.
#pragma once
#include "nodes/motion/motion.h"

namespace kinegraph {

struct QuaternionMean {
  Quat mean;  // unit, w >= 0
  double spread = 0;  // σ = sqrt(mean of ‖log(q̄⁻¹ q)‖²): root mean square of the half-angle to the mean, rad
  double residual = 0;  // ‖mean of log(q̄⁻¹ q)‖: 0 at a Karcher mean, rad
};

// The Karcher mean: the q̄ whose logs log(q̄⁻¹ q) sum to zero, q taken with the sign nearer to q̄. It does not
// depend on the order of frames beyond rounding, and its zero sum survives scaling the logs, which
// StyleTransfer lives on. Found by Newton's method on the sphere from the chordal mean, to machine precision;
// sums run in the order of frames. Rotations spread over more than half the sphere may have several; the one
// near the chordal mean is taken, and where none is reached `residual` tells. No frames: the identity with
// spread 0.
QuaternionMean karcher_mean(const ConstQuatTrack& rotations);

// The running mean of [Wu eq. 6], q̄ₙ = Slerp(1/n, q̄ₙ₋₁, qₙ). Printed, the weight of the newest frame is
// (n−1)/n, which returns nearly the last frame. Depends on the order of frames.
QuaternionMean slerp_mean(const ConstQuatTrack& rotations);

}  // namespace kinegraph
