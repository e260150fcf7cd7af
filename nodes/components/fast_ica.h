// FastICA [Hyvärinen 1999; Hyvärinen & Oja 2000], as Shapiro et al. and Cao et al. use it: a rotation of
// whitened axes (principal.h) that makes the signals as non-Gaussian as can be.
#pragma once
#include <cstddef>
#include <cstdint>

#include "graph/work.h"
#include "nodes/components/rows.h"

namespace kinegraph {

enum class Nonlinearity { logcosh, pow3, gauss };

struct FastIcaParams {
  Nonlinearity nonlinearity = Nonlinearity::logcosh;
  bool symmetric = true;    // false: deflation, one component at a time
  double tolerance = 1e-4;  // on max_i | |<w_i new, w_i old>| - 1 |
  int iterations = 200;
  int patience = 40;  // rounds without coming nearer, after which the step is halved
};

struct FastIcaRun {
  Rows w;  // k x k, orthonormal rows: u = w z
  int iterations = 0;
  bool converged = false;
  double reached = 0;     // the tolerance reached
  double negentropy = 0;  // Σ (E[log cosh u] - 0.3745672)²
};

// One run from `start` (k x k, any regular matrix; rows are the first guesses). A run that goes round
// without coming nearer goes on with half the step (stabilised FastICA).
FastIcaRun fast_ica(const Rows& z, const Rows& start, const FastIcaParams& params, Work& work);

// The n-th starting rotation of a fixed sequence: the identity first, then quasi-random. With seed != 0 all
// are random.
Rows starting_rotation(std::size_t k, int n, std::uint64_t seed);

// u = w z.
Rows rotated(const Rows& w, const Rows& z);
// (E[log cosh u] - 0.3745672)²: 0.3745672 is a unit Gaussian's. And the sum of it over rows.
double negentropy_of_row(const double* u, std::size_t count);
double negentropy(const Rows& u);

}  // namespace kinegraph
