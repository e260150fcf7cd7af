#include "nodes/cartoon/chain_bend.h"

#include <algorithm>

namespace kinegraph {
namespace {

// Always as many, so that the result changes smoothly from frame to frame: after these a point moves by under
// a percent of the offset.
constexpr int rotation_rounds = 6;

// Second derivatives at the knots of the cubic spline through `y` over `x`: level at the first, free at the
// last.
std::vector<double> curvatures(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> below(n), diagonal(n), above(n), right(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i + 1 == n) {
      diagonal[i] = 1;
      break;
    }
    const double h = x[i + 1] - x[i], slope = (y[i + 1] - y[i]) / h;
    if (i == 0) {
      diagonal[i] = 2 * h;
      above[i] = h;
      right[i] = 6 * slope;
    } else {
      const double before = x[i] - x[i - 1];
      below[i] = before;
      diagonal[i] = 2 * (before + h);
      above[i] = h;
      right[i] = 6 * (slope - (y[i] - y[i - 1]) / before);
    }
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = below[i] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    right[i] -= factor * right[i - 1];
  }
  std::vector<double> m(n);
  for (std::size_t i = n; i-- > 0;) m[i] = (right[i] - (i + 1 < n ? above[i] * m[i + 1] : 0)) / diagonal[i];
  return m;
}

double spline_at(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& m,
                 double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin()) - 1;
  const double h = x[i + 1] - x[i], a = (x[i + 1] - at) / h, b = (at - x[i]) / h;
  return a * y[i] + b * y[i + 1] + ((a * a * a - a) * m[i] + (b * b * b - b) * m[i + 1]) * h * h / 6;
}

}  // namespace

std::vector<std::vector<double>> bend_weights(const std::vector<double>& given,
                                              const std::vector<double>& wanted) {
  std::vector<double> knots{0};
  knots.insert(knots.end(), given.begin(), given.end());
  std::vector<std::vector<double>> rows(wanted.size(), std::vector<double>(given.size()));
  for (std::size_t g = 0; g < given.size(); ++g) {
    std::vector<double> y(knots.size());
    y[g + 1] = 1;
    const std::vector<double> m = curvatures(knots, y);
    for (std::size_t w = 0; w < wanted.size(); ++w) rows[w][g] = spline_at(knots, y, m, wanted[w]);
  }
  return rows;
}

std::vector<Vec3> bent_chain(std::span<const Vec3> chain, std::span<const double> places,
                             const std::vector<std::vector<double>>& weights,
                             std::span<const std::size_t> given, std::span<const Vec3> targets) {
  const std::size_t count = chain.size(), last = given.back();
  std::vector<Vec3> bent(chain.begin(), chain.end()), turned(bent);
  for (int round = 0; round <= rotation_rounds; ++round) {
    // The chain of the turned bends: each link's direction is the one before plus the bend.
    if (round > 0) {
      const auto slope = [&](std::size_t i) {
        return (chain[i] - chain[i - 1]) / (places[i] - places[i - 1]);
      };
      const auto turn_of = [&](std::size_t i) {
        return smallest_turn(chain[i] - chain[i - 1], bent[i] - bent[i - 1]);
      };
      Vec3 direction = slope(1);
      Quat above = turn_of(1);
      turned[1] = chain[1];
      for (std::size_t i = 2; i <= last; ++i) {
        const Quat below = turn_of(i);
        direction += rotate(slerp(0.5, above, below), slope(i) - slope(i - 1));
        turned[i] = turned[i - 1] + (places[i] - places[i - 1]) * direction;
        above = below;
      }
    }
    for (std::size_t i = 1; i <= last; ++i) {
      bent[i] = turned[i];
      for (std::size_t g = 0; g < given.size(); ++g)
        bent[i] += weights[i][g] * (targets[g] - turned[given[g]]);
    }
  }
  for (std::size_t i = last + 1; i < count; ++i) bent[i] = chain[i] + (bent[last] - chain[last]);
  return bent;
}

}  // namespace kinegraph
