#include "nodes/time/gaussian.h"

#include <cmath>

#include "nodes/motion/elementary.h"
#include "nodes/time/lowpass.h"

namespace kinegraph {

Gaussian::Gaussian(double sigma, std::size_t frames) {
  double cut = std::ceil(6 * sigma);
  double most = frames > 0 ? static_cast<double>(frames - 1) : 0;
  auto radius = static_cast<std::size_t>(std::fmin(cut, most));
  double sum = 0;
  for (std::size_t k = 0; k <= radius; ++k) {
    double x = static_cast<double>(k) / sigma;
    weights_.push_back(exponential(-0.5 * x * x));
    sum += k == 0 ? weights_[k] : 2 * weights_[k];
  }
  for (double& w : weights_) w /= sum;
}

void Gaussian::apply(std::span<double> series) const {
  if (series.size() < 2) return;
  auto radius = static_cast<std::ptrdiff_t>(weights_.size()) - 1;
  auto count = static_cast<std::ptrdiff_t>(series.size());
  std::vector<double> longer(series.size() + 2 * static_cast<std::size_t>(radius));
  for (std::ptrdiff_t i = -radius; i < count + radius; ++i) longer[i + radius] = reflected(series, i);
  for (double& x : series) x = 0;
  // Neighbours at once, so that their sums stay in registers; each sum is taken in the same order.
  constexpr std::ptrdiff_t lanes = 8;
  const double* middle = longer.data() + radius;
  std::ptrdiff_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    double sum[lanes] = {};
    for (std::ptrdiff_t k = radius; k > 0; --k) {
      const double weight = weights_[k];
      const double *before = middle + i - k, *after = middle + i + k;
      for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) sum[lane] += weight * (before[lane] + after[lane]);
    }
    for (std::ptrdiff_t lane = 0; lane < lanes; ++lane)
      series[i + lane] = sum[lane] + weights_[0] * middle[i + lane];
  }
  for (; i < count; ++i) {
    double sum = 0;
    for (std::ptrdiff_t k = radius; k > 0; --k) sum += weights_[k] * (middle[i - k] + middle[i + k]);
    series[i] = sum + weights_[0] * middle[i];
  }
}

double gaussian_sigma(double cutoff) {
  constexpr double root_of_twice_ln2 = 1.17741002251547469;
  return root_of_twice_ln2 / (2 * pi * cutoff);
}

}  // namespace kinegraph
