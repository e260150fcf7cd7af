// Decomposes clips into independent components [Shapiro §3, Cao §3]: channels, principal components, FastICA
// from several starts, and an order and signs that don't depend on chance.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/components/components.h"
#include "nodes/components/fast_ica.h"

namespace kinegraph {

struct IcaParams {
  int components = 0;  // 0 = as few as explain `variance`
  double variance = 0.95;
  bool rotate = true;  // false: principal components as they are, for comparison
  FastIcaParams fast_ica;
  std::uint64_t seed = 0;  // 0: the fixed sequence of starts
  int starts = 8;
};

// What FastICA found in channels (D x T), without any idea of motion.
struct Decomposition {
  std::vector<double> mean;
  Rows mixing, unmixing, signals;
  std::vector<double> shares;
  bool converged = true;
  int iterations = 0;
  double reached = 0, negentropy = 0;
  std::vector<bool> unique;
};
// Errors: "too-few-frames", "no-variance", "too-many-components" (naming the rank). Warnings:
// "not-converged", "not-unique" (naming the components that other optima of at least 0.9 of the negentropy
// lack, optima.h), "sign-not-sure" (naming the components). Order: by share of variance. Sign: positive
// skewness where |skewness| > 0.3, else the largest |entry| of the mixing column positive.
Decomposition decompose(const Rows& channels, const IcaParams& params, Work& work);

// Joined clips of one kind and rate, frame after frame. `space` is theirs (space_of_motions,
// space_of_points).
Components components_of_motions(ChannelSpace space,
                                 const std::vector<std::shared_ptr<const Motion>>& motions,
                                 const IcaParams& params, Work& work);
Components components_of_points(ChannelSpace space, const std::vector<std::shared_ptr<const Points>>& points,
                                const IcaParams& params, Work& work);

}  // namespace kinegraph
