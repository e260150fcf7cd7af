// Smoothing by a Gaussian that is sampled at the frames, cut at ⌈6 σ⌉ frames (at most N - 1) each side and
// normalised to sum 1. At the ends odd reflection, 2 x₀ - x_k, so a uniform motion is unchanged. Its gain at
// frequency f is exp(-(2π f σ)²/2).
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace kinegraph {

class Gaussian {
 public:
  // `sigma` in frames, above 0; `frames`: of the series it is for.
  Gaussian(double sigma, std::size_t frames);
  // weights()[k] is that of the frames k before and k after.
  const std::vector<double>& weights() const { return weights_; }
  void apply(std::span<double> series) const;  // of `frames` samples

 private:
  std::vector<double> weights_;
};

// σ in seconds of the Gaussian whose gain at `cutoff` Hz is one half.
double gaussian_sigma(double cutoff);

}  // namespace kinegraph
