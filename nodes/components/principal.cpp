#include "nodes/components/principal.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>

#include "nodes/components/ica_kernels.h"

namespace kinegraph {
namespace {

// Calls use(x, start, count) with the channels less their means, D rows of `count` columns `slice` apart: one
// slice of the frames after the other, small enough for the second cache.
constexpr std::size_t slice = 256;
template <class Use>
void for_centred_slices(const Rows& channels, const std::vector<double>& mean, Work& work, Use use) {
  const auto x = hwy::AllocateAligned<double>(channels.rows * slice);
  for (std::size_t start = 0; start < channels.columns; start += slice) {
    const std::size_t count = std::min(slice, channels.columns - start);
    for (std::size_t i = 0; i < channels.rows; ++i)
      subtract_from_row(channels.row(i) + start, count, mean[i], x.get() + i * slice);
    use(x.get(), start, count);
    work.check();
  }
}

std::vector<double> means_of(const Rows& channels, Work& work) {
  std::vector<double> means(channels.rows);
  const auto columns = static_cast<double>(channels.columns);
  for (std::size_t i = 0; i < channels.rows; ++i) {
    if (i % 16 == 0) work.check();
    const double mean = sum_of_row(channels.row(i), channels.columns, 0) / columns;
    means[i] = mean + sum_of_row(channels.row(i), channels.columns, mean) / columns;  // its rounding
  }
  return means;
}

// Σ y yᵀ with y = axes (x - mean), all x where `axes` has as many rows as columns.
Rows scatter_along(const Rows& axes, const Rows& channels, const std::vector<double>& mean, Work& work) {
  const std::size_t m = axes.rows, d = axes.columns;
  const std::size_t bytes = m * m * kernel_lanes * sizeof(double);
  const auto reserved = bytes > (std::size_t{16} << 20) ? work.reserve(bytes) : nullptr;
  std::vector<double> sums(m * m * kernel_lanes);
  const auto projected = hwy::AllocateAligned<double>(m * slice);
  for_centred_slices(channels, mean, work, [&](const double* x, std::size_t, std::size_t count) {
    if (m < d) {
      mix_rows(axes.data.data(), m, d, x, slice, count, projected.get(), slice);
      x = projected.get();
    }
    add_products(x, slice, m, x, slice, m, count, true, sums.data());
  });
  Rows out(m, m);
  add_up_lanes(sums.data(), m * m, out.data.data());
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i + 1; j < m; ++j) out(i, j) = out(j, i);
  return out;
}

}  // namespace

namespace {

// Decomposes the axes from `first` on, in the space of these alone. Returns the first axis under 1e-8 of its
// variance: a covariance knows small variances only to 1e-16 of the largest.
std::size_t decompose_from(std::size_t first, Principal& out, const Rows& channels, Work& work) {
  const std::size_t d = channels.rows, m = d - first;
  Rows axes(m, d);
  std::copy_n(out.axes.row(first), m * d, axes.data.data());
  const Eigenpairs pairs = symmetric_eigen(scatter_along(axes, channels, out.mean, work));
  const Rows turned = first > 0 ? product(pairs.vectors, axes) : pairs.vectors;
  std::copy_n(turned.data.data(), m * d, out.axes.row(first));
  for (std::size_t i = 0; i < m; ++i)
    out.variance[first + i] = std::max(0.0, pairs.values[i]) / static_cast<double>(channels.columns);
  std::size_t next = first + 1;
  while (next < d && out.variance[next] > 1e-8 * out.variance[first]) ++next;
  return next;
}

}  // namespace

Principal leading_components(const Rows& channels, Work& work) {
  const std::size_t d = channels.rows;
  Principal out{means_of(channels, work), std::vector<double>(d), identity(d), 0};
  const std::size_t exact = decompose_from(0, out, channels, work);
  while (out.rank < exact && out.variance[out.rank] > 0) ++out.rank;
  return out;
}

Principal principal_components(const Rows& channels, Work& work) {
  const std::size_t d = channels.rows;
  Principal out = leading_components(channels, work);
  // The small axes are decomposed once more, in a space where they are the large ones; and so on, until the
  // rest is rounding.
  for (std::size_t next = out.rank; next > 0 && next < d && out.variance[next] > 1e-22 * out.variance[0];)
    next = decompose_from(next, out, channels, work);
  out.rank = 0;
  while (out.rank < d && out.variance[out.rank] > 1e-20 * out.variance[0]) ++out.rank;
  return out;
}

Whitened whiten(const Rows& channels, const Principal& principal, std::size_t k, Work& work) {
  const std::size_t d = channels.rows, columns = channels.columns;
  Whitened out{Rows(k, columns), Rows(d, k), Rows(k, d)};
  for (std::size_t i = 0; i < k; ++i) {
    const double sigma = std::sqrt(principal.variance[i]);
    for (std::size_t j = 0; j < d; ++j) {
      out.p(j, i) = principal.axes(i, j) * sigma;
      out.p_inverse(i, j) = principal.axes(i, j) / sigma;
    }
  }
  for_centred_slices(
      channels, principal.mean, work, [&](const double* x, std::size_t start, std::size_t count) {
        mix_rows(out.p_inverse.data.data(), k, d, x, slice, count, out.z.data.data() + start, columns);
      });
  return out;
}

}  // namespace kinegraph
