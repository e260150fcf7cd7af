#include "nodes/cartoon/chain_bend.h"

#include <algorithm>

namespace kinegraph {
namespace {

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

}  // namespace kinegraph
