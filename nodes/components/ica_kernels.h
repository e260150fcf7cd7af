// The loops over frames of principal components and FastICA, compiled for several instruction sets with the
// same bits from each: eight running sums ("lanes") whatever the vector width, added up in one order, no
// fused multiply-adds.
//
// Rows lie `stride` numbers apart, each contiguous; loops are twice as fast where they start at multiples of
// 64 bytes. Sums in lanes are carried from call to call: frames in several calls give the same bits as in
// one, as long as all calls but the last have a multiple of eight.
#pragma once
#include <cstddef>

namespace kinegraph {

constexpr std::size_t kernel_lanes = 8;
// Columns in which moments are taken, so that they stay in the first cache.
constexpr std::size_t moment_slice = 128;

// Σ (x - shift).
double sum_of_row(const double* x, std::size_t count, double shift);
// out = x - shift.
void subtract_from_row(const double* x, std::size_t count, double shift, double* out);

// sums[(i * n + j) * 8 ...] += a_i b_j for rows i < m of a, j < n of b. `symmetric`: a and b are the same
// rows; only the lower triangle (j <= i) is sure to be summed.
void add_products(const double* a, std::size_t a_stride, std::size_t m, const double* b, std::size_t b_stride,
                  std::size_t n, std::size_t count, bool symmetric, double* sums);
// out[i] = the i-th eight lanes added up.
void add_up_lanes(const double* sums, std::size_t count, double* out);

// y_i[t] = Σ_j w[i * k + j] z_j[t], summed in the order of j. y has m rows, z k rows.
void mix_rows(const double* w, std::size_t m, std::size_t k, const double* z, std::size_t z_stride,
              std::size_t count, double* y, std::size_t y_stride);

// With y = w z: zg[(i * k + j) * 8 ...] += g(y_i) z_j, slope[i * 8 ...] += g'(y_i). w has m rows of k;
// `scratch` has room for (m + k) * moment_slice numbers. kind 0: g = tanh y; 1: y³; 2: y exp(-y²/2).
void add_moments(int kind, const double* w, std::size_t m, const double* z, std::size_t stride, std::size_t k,
                 std::size_t count, double* scratch, double* zg, double* slope);

// Σ ln cosh y over a row.
double sum_of_log_cosh(const double* y, std::size_t count);

// Σ √(1 + x²) of a and b turned into each other: x = c a + s b into sums[0], x = c b - s a into sums[1].
void turned_roots(const double* a, const double* b, std::size_t count, double c, double s, double* sums);

}  // namespace kinegraph
