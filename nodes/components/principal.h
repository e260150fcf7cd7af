// Principal components: the axes along which channels vary most, found before independent components [Shapiro
// §3.1, Cao §3].
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/components/rows.h"

namespace kinegraph {

// Principal components of channels (D x T): variances (divided by T) of all axes, largest first, and their
// directions.
struct Principal {
  std::vector<double> mean;  // D
  std::vector<double>
      variance;          // D, >= 0, falling; small ones to nearly full relative accuracy, as from an SVD
  Rows axes;             // D x D: row i is the unit axis of variance[i]
  std::size_t rank = 0;  // axes whose singular value is over 1e-10 of the first
};
Principal principal_components(const Rows& channels, Work& work);

// The same as far as a covariance tells: `rank` counts the axes whose singular value is over 1e-4 of the
// first, which are as exact as above; the others are only known to be smaller. In half the time.
Principal leading_components(const Rows& channels, Work& work);

// z = Λ^{-1/2} E^T (x - mean): k rows of unit variance; and P (D x k) with x ≈ mean + P z.
struct Whitened {
  Rows z;          // k x T
  Rows p;          // D x k
  Rows p_inverse;  // k x D: z = p_inverse (x - mean)
};
// Of the channels that `principal` was found in. k <= rank.
Whitened whiten(const Rows& channels, const Principal& principal, std::size_t k, Work& work);

}  // namespace kinegraph
