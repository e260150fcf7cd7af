#include "nodes/motion/half_angle.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace kinegraph {

// Two halvings bring the sine under 0.383, where the series of asin(u)/u in u² is short; it is several times
// faster than an arc tangent.
double angle_over_sine(double sine2, double cosine) {
  const double half = std::sqrt(0.5 * (1 + cosine));                 // cos θ/2
  const double quarter = std::sqrt(0.5 * (1 + half));                // cos θ/4
  const double u2 = sine2 / (16 * half * half * quarter * quarter);  // sin² θ/4
  // (2n)! / (4ⁿ n!² (2n+1)), n = 0…18: the next term is under 2e-18 at u² = 0.1465.
  static constexpr std::array<double, 19> term = [] {
    std::array<double, 19> t{};
    double binomial = 1;
    for (int n = 0; n < 19; ++n) {
      t[static_cast<std::size_t>(n)] = binomial / (2 * n + 1);
      binomial *= (2.0 * n + 1) / (2.0 * n + 2);
    }
    return t;
  }();
  double sum = 0;
  if (u2 < 0.01) {  // θ under 23°: the tenth term is already under 1e-18
    for (int n = 8; n >= 0; --n) sum = sum * u2 + term[static_cast<std::size_t>(n)];
  } else {
    for (int n = 18; n >= 0; --n) sum = sum * u2 + term[static_cast<std::size_t>(n)];
  }
  return sum / (half * quarter);  // 4 asin(u) / (4 u cos(θ/4) cos(θ/2))
}

}  // namespace kinegraph
