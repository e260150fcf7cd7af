// Smooths a motion in time without delay.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct FilterSettings {
  enum class Method { lowpass, gaussian };
  Method method = Method::lowpass;
  double cutoff = 6;  // Hz: where one half is left, with either method
  int order = 2;      // of the Butterworth filter, which runs both ways
};

// Filters the rotations, and the translations where they vary, of the chosen joints. Rotations are filtered
// as logarithms about a slow reference, so that the gain is the filter's own; joints that turn too far for
// that (cartwheels) as quaternions, normalised. At the ends a motion is continued by q₀ q_k⁻¹ q₀, so steady
// turning is left alone.
Motion filtered(const Motion& motion, const std::vector<bool>& joints, const FilterSettings& settings,
                Work& work);

}  // namespace kinegraph
