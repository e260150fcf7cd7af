#include "nodes/cartoon/group_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kinegraph {
namespace {

constexpr double merged_link = 0.02;         // of the group's length
constexpr std::size_t most_knots = 5;        // of one curve
constexpr std::size_t knots_of_a_piece = 4;  // where it is split

using Rows = std::vector<std::vector<double>>;

// B_i^n(x) for i = 0…n.
std::vector<double> bernstein(std::size_t degree, double x) {
  std::vector<double> b{1};
  for (std::size_t n = 1; n <= degree; ++n) {  // de Casteljau
    b.push_back(0);
    for (std::size_t i = n; i > 0; --i) b[i] = (1 - x) * b[i] + x * b[i - 1];
    b[0] *= 1 - x;
  }
  return b;
}

std::vector<double> bernstein_slope(std::size_t degree, double x) {
  const std::vector<double> lower = bernstein(degree - 1, x);
  std::vector<double> slope(degree + 1);
  for (std::size_t i = 0; i <= degree; ++i)
    slope[i] = static_cast<double>(degree) * ((i > 0 ? lower[i - 1] : 0) - (i < degree ? lower[i] : 0));
  return slope;
}

// The rows x of a x = b, by elimination with pivots.
Rows solved(Rows a, Rows b) {
  const std::size_t n = a.size();
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t r = column + 1; r < n; ++r)
      if (std::fabs(a[r][column]) > std::fabs(a[pivot][column])) pivot = r;
    std::swap(a[column], a[pivot]);
    std::swap(b[column], b[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == column) continue;
      const double factor = a[r][column] / a[column][column];
      for (std::size_t c = column; c < n; ++c) a[r][c] -= factor * a[column][c];
      for (std::size_t c = 0; c < b[r].size(); ++c) b[r][c] -= factor * b[column][c];
    }
  }
  for (std::size_t r = 0; r < n; ++r)
    for (double& value : b[r]) value /= a[r][r];
  return b;
}

// Derivative at knot i of the parabola through knots i − 1, i, i + 1: weights of these three.
std::vector<double> parabola_slope(const std::vector<double>& u, std::size_t i) {
  std::vector<double> weights(u.size());
  const double before = u[i] - u[i - 1], after = u[i + 1] - u[i];
  weights[i - 1] = -after / (before * (before + after));
  weights[i] = (after - before) / (before * after);
  weights[i + 1] = before / (after * (before + after));
  return weights;
}

// One Bézier over knots first…last, with given slopes at inner ends.
struct Piece {
  std::size_t first, last;
  double start, size;  // in the parameter
  Rows controls;       // each control point as weights of all knots
  std::vector<double> at(double u) const {
    const std::vector<double> basis = bernstein(controls.size() - 1, (u - start) / size);
    std::vector<double> row(controls[0].size());
    for (std::size_t i = 0; i < basis.size(); ++i)
      for (std::size_t k = 0; k < row.size(); ++k) row[k] += basis[i] * controls[i][k];
    return row;
  }
};

Piece piece_over(const std::vector<double>& u, std::size_t first, std::size_t last) {
  Piece piece{first, last, u[first], u[last] - u[first], {}};
  const bool slope_before = first > 0, slope_after = last + 1 < u.size();
  const std::size_t degree = last - first + (slope_before ? 1 : 0) + (slope_after ? 1 : 0);
  Rows conditions, values;
  for (std::size_t k = first; k <= last; ++k) {
    conditions.push_back(bernstein(degree, (u[k] - piece.start) / piece.size));
    values.emplace_back(u.size());
    values.back()[k] = 1;
  }
  const auto slope = [&](std::size_t knot, double x) {
    conditions.push_back(bernstein_slope(degree, x));
    values.push_back(parabola_slope(u, knot));
    for (double& value : values.back()) value *= piece.size;
  };
  if (slope_before) slope(first, 0);
  if (slope_after) slope(last, 1);
  piece.controls = solved(std::move(conditions), std::move(values));
  return piece;
}

std::vector<Piece> pieces_over(const std::vector<double>& u) {
  std::vector<Piece> pieces;
  const std::size_t links = u.size() - 1;
  const std::size_t count =
      u.size() <= most_knots ? 1 : (links + knots_of_a_piece - 2) / (knots_of_a_piece - 1);
  for (std::size_t i = 0; i < count; ++i)
    pieces.push_back(piece_over(u, links * i / count, links * (i + 1) / count));
  return pieces;
}

}  // namespace

CurveWeights curve_weights(std::span<const double> lengths, std::span<const CurvePoint> wanted) {
  CurveWeights weights;
  weights.joints = lengths.size() + 1;
  weights.rows.resize(weights.joints * wanted.size());
  double total = 0;
  for (double length : lengths) total += length;

  // Parameters of all joints, and which of them are knots.
  std::vector<double> joint_u{0}, knot_u{0};
  std::vector<std::size_t> knots{0};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    joint_u.push_back(total > 0 ? joint_u.back() + lengths[i] / total : 0);
    if (total > 0 && joint_u.back() - knot_u.back() >= merged_link) {
      knots.push_back(i + 1);
      knot_u.push_back(joint_u.back());
    }
  }
  std::vector<Piece> pieces;
  if (knots.size() > 1) pieces = pieces_over(knot_u);

  for (std::size_t p = 0; p < wanted.size(); ++p) {
    double* row = weights.rows.data() + p * weights.joints;
    const std::size_t k = wanted[p].link;
    if (wanted[p].part == 0 || pieces.empty() || k + 1 >= weights.joints) {
      row[k] = 1;  // a joint itself: exactly
      continue;
    }
    const double u = joint_u[k] + wanted[p].part * (joint_u[k + 1] - joint_u[k]);
    if (u > knot_u.back()) {  // a merged link at the tip: straight
      row[k] = 1 - wanted[p].part;
      row[k + 1] = wanted[p].part;
      continue;
    }
    const auto piece = std::find_if(pieces.begin(), pieces.end() - 1,
                                    [&](const Piece& one) { return u <= one.start + one.size; });
    const std::vector<double> at = piece->at(u);
    for (std::size_t i = 0; i < knots.size(); ++i) row[knots[i]] += at[i];
  }
  return weights;
}

}  // namespace kinegraph
