// Smoothness as spectral arc length.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace kinegraph {

// SPARC of a speed profile [Balasubramanian, Melendez-Calderon, Roby-Brami, Burdet: On the analysis of
// movement smoothness, J. NeuroEng. Rehab. 12:112, 2015]: minus the length of the curve of the magnitude
// spectrum, V̂(f) = |V(f)|/|V(0)| over f/f_c, from 0 to f_c, the last frequency up to `cutoff` where V̂ reaches
// `threshold`. The spectrum is that of the profile padded with zeros to 2^(⌈log2 N⌉ + 4) samples, as in the
// paper's code. Always below −1; nearer to it is smoother. Made once for profiles of one length and rate,
// then used from any thread.
class SpectralArcLength {
 public:
  SpectralArcLength(std::size_t samples, double fps, double cutoff = 10, double threshold = 0.05);
  ~SpectralArcLength();
  // Of `samples` speeds. Nothing for fewer than two samples, for a point at rest (never above 1e-6), or where
  // only one bin of the spectrum counts.
  std::optional<double> operator()(std::span<const double> speed) const;

 private:
  struct Transform;
  std::unique_ptr<const Transform> transform_;
};

}  // namespace kinegraph
