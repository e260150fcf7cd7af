// FastICA [Hyvärinen 1999; Hyvärinen & Oja 2000], as Shapiro et al. and Cao et al. use it: whitening by
// principal components, then a rotation of the whitened axes that makes the signals as non-Gaussian as can
// be.
#pragma once
#include <cstdint>
#include <vector>

#include "graph/work.h"
#include "nodes/components/rows.h"

namespace kinegraph {

// Principal components of channels (D x T): variances (divided by T) of all axes, largest first, and their
// directions.
struct Principal {
  std::vector<double> mean;  // D
  Rows centred;              // D x T: the channels without their means
  std::vector<double>
      variance;          // D, >= 0, falling; small ones to nearly full relative accuracy, as from an SVD
  Rows axes;             // D x D: row i is the unit axis of variance[i]
  std::size_t rank = 0;  // axes whose singular value is over 1e-10 of the first
};
Principal principal_components(const Rows& channels, Work& work);

// z = Λ^{-1/2} E^T (x - mean): k rows of unit variance; and P (D x k) with x ≈ mean + P z.
struct Whitened {
  Rows z;          // k x T
  Rows p;          // D x k
  Rows p_inverse;  // k x D: z = p_inverse (x - mean)
};
// k <= rank.
Whitened whiten(const Principal& principal, std::size_t k, Work& work);

enum class Nonlinearity { logcosh, pow3, gauss };

struct FastIcaParams {
  Nonlinearity nonlinearity = Nonlinearity::logcosh;
  bool symmetric = true;    // false: deflation, one component at a time
  double tolerance = 1e-4;  // on max_i | |<w_i new, w_i old>| - 1 |
  int iterations = 200;
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

// A run may have ended in an optimum that turning just two of its components would leave [Tichavský,
// Koldovský & Oja 2006, test of saddle points]: such turns are tried for every pair, and where one has a
// larger negentropy FastICA goes on from there. Returns the better run, or `run` (also where there are more
// than 20 components).
FastIcaRun leave_side_optimum(const Rows& z, FastIcaRun run, const FastIcaParams& params, Work& work);

// The n-th starting rotation of a fixed sequence: the identity first, then quasi-random. With seed != 0 all
// are random.
Rows starting_rotation(std::size_t k, int n, std::uint64_t seed);

// u = w z.
Rows rotated(const Rows& w, const Rows& z);
// Σ over the rows of (E[log cosh u] - 0.3745672)²: 0.3745672 is a unit Gaussian's.
double negentropy(const Rows& u);

}  // namespace kinegraph
