// Small dense matrices of doubles, row after row. A row is often a time series, contiguous.
#pragma once
#include <cstddef>
#include <vector>

namespace kinegraph {

struct Rows {
  std::size_t rows = 0, columns = 0;
  std::vector<double> data;
  Rows() = default;
  Rows(std::size_t r, std::size_t c) : rows(r), columns(c), data(r * c) {}
  double* row(std::size_t r) { return data.data() + r * columns; }
  const double* row(std::size_t r) const { return data.data() + r * columns; }
  double& operator()(std::size_t r, std::size_t c) { return data[r * columns + c]; }
  double operator()(std::size_t r, std::size_t c) const { return data[r * columns + c]; }
};

Rows identity(std::size_t n);
Rows product(const Rows& a, const Rows& b);
Rows transposed(const Rows& a);

// Of a symmetric matrix: eigenvalues, largest first, and their unit vectors as rows.
struct Eigenpairs {
  std::vector<double> values;
  Rows vectors;
};
Eigenpairs symmetric_eigen(const Rows& symmetric);

// (A Aᵀ)^{-1/2} A: the orthonormal rows nearest to those of A, which has no more rows than columns; also of
// dependent rows, where what they leave open is filled somehow.
Rows nearest_orthonormal(const Rows& a);

}  // namespace kinegraph
