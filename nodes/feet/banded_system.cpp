#include "nodes/feet/banded_system.h"

#include <algorithm>

namespace kinegraph {

BandedSystem::BandedSystem(std::size_t size, std::size_t half_width)
    : size_(size), width_(half_width), band_(size * (half_width + 1), 0.0) {}

void BandedSystem::factor() {
  const std::size_t stride = width_ + 1;
  for (std::size_t i = 0; i < size_; ++i) {
    double* row = &band_[i * stride];
    const std::size_t first = i < width_ ? 0 : i - width_;
    // Row i of L D, then of L.
    for (std::size_t j = first; j < i; ++j) {
      const double* other = &band_[j * stride];
      const std::size_t from = std::max(first, j < width_ ? 0 : j - width_);
      double sum = row[i - j];
      for (std::size_t k = from; k < j; ++k) sum -= row[i - k] * other[j - k];
      row[i - j] = sum;
    }
    double pivot = row[0];
    for (std::size_t j = first; j < i; ++j) {
      const double scaled = row[i - j] / band_[j * stride];
      pivot -= scaled * row[i - j];
      row[i - j] = scaled;
    }
    row[0] = pivot;
  }
}

void BandedSystem::solve(std::vector<double>& x) const {
  const std::size_t stride = width_ + 1;
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t j = i < width_ ? 0 : i - width_; j < i; ++j) x[i] -= band_[i * stride + (i - j)] * x[j];
  for (std::size_t i = 0; i < size_; ++i) x[i] /= band_[i * stride];
  for (std::size_t i = size_; i-- > 0;)
    for (std::size_t j = i < width_ ? 0 : i - width_; j < i; ++j) x[j] -= band_[i * stride + (i - j)] * x[i];
}

}  // namespace kinegraph
