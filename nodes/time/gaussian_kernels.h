// The sum of a symmetric filter at the width of the CPU's vectors; results are the same at every width.
#pragma once
#include <cstddef>

namespace kinegraph {

// out[i] = Σ_k weights[k] (middle[i − k] + middle[i + k]), k from `radius` down to 1, + weights[0] middle[i];
// `middle` can be read from −radius to count + radius − 1. Doesn't overlap `out`.
void symmetric_sums(const double* middle, std::size_t count, const double* weights, std::size_t radius,
                    double* out);

}  // namespace kinegraph
