#include "nodes/components/rows.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace kinegraph {

Rows identity(std::size_t n) {
  Rows out(n, n);
  for (std::size_t i = 0; i < n; ++i) out(i, i) = 1;
  return out;
}

Rows product(const Rows& a, const Rows& b) {
  Rows out(a.rows, b.columns);
  for (std::size_t i = 0; i < a.rows; ++i)
    for (std::size_t k = 0; k < a.columns; ++k)
      for (std::size_t j = 0; j < b.columns; ++j) out(i, j) += a(i, k) * b(k, j);
  return out;
}

Rows transposed(const Rows& a) {
  Rows out(a.columns, a.rows);
  for (std::size_t i = 0; i < a.rows; ++i)
    for (std::size_t j = 0; j < a.columns; ++j) out(j, i) = a(i, j);
  return out;
}

Eigenpairs symmetric_eigen(const Rows& symmetric) {
  const auto n = static_cast<Eigen::Index>(symmetric.rows);
  Eigen::MatrixXd matrix = Eigen::Map<const Eigen::MatrixXd>(symmetric.data.data(), n, n);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  Eigenpairs out{std::vector<double>(symmetric.rows), Rows(symmetric.rows, symmetric.rows)};
  for (Eigen::Index i = 0; i < n; ++i) {  // Eigen's come rising
    out.values[static_cast<std::size_t>(i)] = solver.eigenvalues()[n - 1 - i];
    for (Eigen::Index j = 0; j < n; ++j)
      out.vectors(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) =
          solver.eigenvectors()(j, n - 1 - i);
  }
  return out;
}

namespace {

// U Vᵀ of a = U Σ Vᵀ: orthonormal however small Σ is.
Rows polar_factor(const Rows& a) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(a.rows), columns = static_cast<Eigen::Index>(a.columns);
  const Eigen::MatrixXd matrix = Eigen::Map<const RowMajor>(a.data.data(), rows, columns);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Rows out(a.rows, a.columns);
  Eigen::Map<RowMajor>(out.data.data(), rows, columns) = svd.matrixU() * svd.matrixV().transpose();
  return out;
}

}  // namespace

Rows nearest_orthonormal(const Rows& a) {
  const Eigenpairs gram = symmetric_eigen(product(a, transposed(a)));
  // Rows that are nearly dependent: A Aᵀ has lost what tells them apart.
  if (!(gram.values.back() > 1e-6 * gram.values.front())) return polar_factor(a);
  Rows scaled = gram.vectors;  // V D^{-1/2} Vᵀ A, with V's columns the rows here
  for (std::size_t i = 0; i < scaled.rows; ++i) {
    const double scale = 1 / std::sqrt(gram.values[i]);
    for (std::size_t j = 0; j < scaled.columns; ++j) scaled(i, j) *= scale;
  }
  return product(product(transposed(gram.vectors), scaled), a);
}

}  // namespace kinegraph
