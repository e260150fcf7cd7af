#include "nodes/time/gaussian.h"

#include <cmath>

#include "nodes/motion/elementary.h"
#include "nodes/time/gaussian_kernels.h"
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
  symmetric_sums(longer.data() + radius, series.size(), weights_.data(), static_cast<std::size_t>(radius),
                 series.data());
}

double gaussian_sigma(double cutoff) {
  constexpr double root_of_twice_ln2 = 1.17741002251547469;
  return root_of_twice_ln2 / (2 * pi * cutoff);
}

}  // namespace kinegraph
