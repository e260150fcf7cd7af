// The loops over frames of whitening and FastICA, compiled for several instruction sets with the same bits
// from each: eight running sums whatever the vector width, added up in one order, no fused multiply-adds.
#pragma once
#include <cstddef>

namespace kinegraph {

// out[i * n + j] = Σ_t a_i[t] b_j[t] for rows i < m of a, j < n of b, rows `columns` long and contiguous.
// `symmetric`: a and b are the same rows; only j <= i is computed and mirrored.
void products_of_rows(const double* a, std::size_t m, const double* b, std::size_t n, std::size_t columns,
                      bool symmetric, double* out);

// y_i[t] = Σ_j w[i * k + j] z_j[t], summed in the order of j. y has m rows, z k rows.
void mix_rows(const double* w, std::size_t m, std::size_t k, const double* z, std::size_t columns, double* y);

// For every entry: g(y) over y in place, and Σ g'(y) of the row into `slope`, and Σ y g(y) into `beta`.
// kind 0: tanh y; 1: y³; 2: y exp(-y²/2).
void nonlinearity_of_row(int kind, double* y, std::size_t columns, double* slope, double* beta);

// Σ ln cosh y over a row.
double sum_of_log_cosh(const double* y, std::size_t columns);

}  // namespace kinegraph
