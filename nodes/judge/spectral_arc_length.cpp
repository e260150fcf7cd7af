#include "nodes/judge/spectral_arc_length.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

struct Complex {
  double re = 0, im = 0;
};
Complex operator*(Complex a, Complex b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Complex operator+(Complex a, Complex b) {
  return {a.re + b.re, a.im + b.im};
}
Complex operator-(Complex a, Complex b) {
  return {a.re - b.re, a.im - b.im};
}

// e^{−2πi k/size}, k = 0 … size − 1.
std::vector<Complex> roots_of_unity(std::size_t size) {
  std::vector<Complex> roots(size);
  for (std::size_t k = 0; k < size; ++k) {
    const SinCos angle = sin_cos(-2 * pi * static_cast<double>(k) / static_cast<double>(size));
    roots[k] = {angle.cos, angle.sin};
  }
  return roots;
}

// In place, radix 2. `roots` are those of a multiple of the size.
void fourier_transform(std::vector<Complex>& x, const std::vector<Complex>& roots) {
  const std::size_t n = x.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (std::size_t half = 1; half < n; half *= 2) {
    const std::size_t stride = roots.size() / (2 * half);
    for (std::size_t start = 0; start < n; start += 2 * half) {
      for (std::size_t k = 0; k < half; ++k) {
        const Complex even = x[start + k];
        const Complex odd = roots[k * stride] * x[start + k + half];
        x[start + k] = even + odd;
        x[start + k + half] = even - odd;
      }
    }
  }
}

constexpr std::size_t padding = 16;

std::size_t power_of_two_from(std::size_t count) {
  std::size_t size = 1;
  while (size < count) size *= 2;
  return size;
}

}  // namespace

struct SpectralArcLength::Transform {
  std::size_t samples = 0;
  std::size_t size = 1;  // of the unpadded transform
  std::size_t bins = 0;  // of the padded one, up to the cutoff
  double threshold = 0;
  std::vector<Complex> roots;

  // |V| at the lowest bins. The padded transform splits by k mod 16 into transforms of the unpadded size,
  // each of the profile times a slow wave.
  std::vector<double> spectrum(std::span<const double> speed) const {
    std::vector<double> magnitudes(bins);
    std::vector<Complex> part(size);
    for (std::size_t residue = 0; residue < padding; ++residue) {
      std::fill(part.begin(), part.end(), Complex{});
      for (std::size_t n = 0; n < speed.size(); ++n) {
        const Complex wave = roots[n * residue];
        part[n] = {speed[n] * wave.re, speed[n] * wave.im};
      }
      fourier_transform(part, roots);
      for (std::size_t k = residue; k < bins; k += padding) {
        const Complex value = part[k / padding];
        magnitudes[k] = std::sqrt(value.re * value.re + value.im * value.im);
      }
    }
    return magnitudes;
  }
};

SpectralArcLength::SpectralArcLength(std::size_t samples, double fps, double cutoff, double threshold) {
  auto transform = std::make_unique<Transform>();
  transform->samples = samples;
  transform->size = power_of_two_from(samples);
  const std::size_t padded = transform->size * padding;
  transform->bins =
      std::min(padded, static_cast<std::size_t>(cutoff / fps * static_cast<double>(padded)) + 1);
  transform->threshold = threshold;
  transform->roots = roots_of_unity(padded);
  transform_ = std::move(transform);
}

SpectralArcLength::~SpectralArcLength() = default;

std::optional<double> SpectralArcLength::operator()(std::span<const double> speed) const {
  if (speed.size() < 2 || speed.size() != transform_->samples) return std::nullopt;
  if (!(*std::max_element(speed.begin(), speed.end()) > 1e-6)) return std::nullopt;
  std::vector<double> spectrum = transform_->spectrum(speed);
  const double largest = *std::max_element(spectrum.begin(), spectrum.end());
  for (double& value : spectrum) value /= largest;

  std::size_t first = 0;
  while (spectrum[first] < transform_->threshold) ++first;
  std::size_t last = spectrum.size() - 1;
  while (spectrum[last] < transform_->threshold) --last;
  if (last == first) return std::nullopt;
  const double step = 1.0 / static_cast<double>(last - first);
  double length = 0;
  for (std::size_t k = first + 1; k <= last; ++k) {
    const double rise = spectrum[k] - spectrum[k - 1];
    length += std::sqrt(step * step + rise * rise);
  }
  return -length;
}

}  // namespace kinegraph
