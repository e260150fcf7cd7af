// A low-pass filter without delay: a Butterworth filter run forwards and then backwards.
// Its gain at frequency f is 1 / (1 + (tan(π f / fps) / tan(π cutoff / fps))^(2 order)): one half at the
// cutoff, as with SciPy's filtfilt. The series is continued at both ends by odd reflection (2 x₀ - x_k), so a
// series that moves uniformly comes back unchanged up to its ends.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace kinegraph {

class Lowpass {
 public:
  // `cutoff` in Hz, above 0; at or above fps / 2 nothing is filtered. `order` of one pass, 1 to 16, even or
  // odd.
  Lowpass(double fps, double cutoff, int order = 2);

  void apply(std::span<double> series) const;
  // The same for a series that the caller has continued at both ends, by memory() samples or more.
  void apply_to_continued(std::span<double> series) const;
  bool passes_all() const { return sections_.empty(); }
  // Samples after which the filter has forgotten what it started from, to some 10 digits.
  std::size_t memory() const { return memory_; }

 private:
  // y = b0 x + s1, s1 = b1 x - a1 y + s2, s2 = b2 x - a2 y
  struct Section {
    double b0, b1, b2, a1, a2;
  };
  void pass(std::span<double> series) const;

  std::vector<Section> sections_;
  std::size_t memory_ = 0;
};

// One series at once.
std::vector<double> lowpass(std::span<const double> series, double fps, double cutoff, int order = 2);

// The element of a series continued at both ends by odd reflection, again and again where it must.
double reflected(std::span<const double> series, std::ptrdiff_t index);

}  // namespace kinegraph
