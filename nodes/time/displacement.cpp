#include "nodes/time/displacement.h"

namespace kinegraph {
namespace {

// Slopes at the knots of the C² cubic spline that is level at both ends, and wherever it rests at 0 from one
// knot to the next: a tridiagonal system.
std::vector<Vec3> slopes(const std::vector<double>& at, const std::vector<Vec3>& value) {
  const std::size_t last = at.size() - 1;
  std::vector<Vec3> slope(at.size());
  std::vector<double> upper(at.size(), 0.0);
  const auto is_zero = [&](std::size_t i) { return value[i] == Vec3{}; };
  for (std::size_t i = 1; i < last; ++i) {
    if (is_zero(i) && (is_zero(i - 1) || is_zero(i + 1))) continue;
    const double before = at[i] - at[i - 1], after = at[i + 1] - at[i];
    const Vec3 right =
        3 * (after / before * (value[i] - value[i - 1]) + before / after * (value[i + 1] - value[i]));
    const double pivot = 2 * (before + after) - after * upper[i - 1];
    upper[i] = before / pivot;
    slope[i] = (right - after * slope[i - 1]) / pivot;
  }
  slope[last] = {};
  for (std::size_t i = last; i-- > 1;) slope[i] -= upper[i] * slope[i + 1];
  slope[0] = {};
  return slope;
}

}  // namespace

std::vector<Vec3> displacement_curve(const std::map<std::size_t, Vec3>& knots, std::size_t frames) {
  std::map<std::size_t, Vec3> all = knots;
  all.try_emplace(0);
  all.try_emplace(frames - 1);
  std::vector<double> at;
  std::vector<Vec3> value;
  for (const auto& [frame, wanted] : all) {
    at.push_back(static_cast<double>(frame));
    value.push_back(wanted);
  }
  std::vector<Vec3> curve(frames, value.front());
  if (at.size() == 1) return curve;
  const std::vector<Vec3> slope = slopes(at, value);
  std::size_t piece = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f);
    while (piece + 2 < at.size() && t >= at[piece + 1]) ++piece;
    const double length = at[piece + 1] - at[piece], u = (t - at[piece]) / length, w = 1 - u;
    curve[f] = w * w * (1 + 2 * u) * value[piece] + u * u * (1 + 2 * w) * value[piece + 1] +
               length * u * w * (w * slope[piece] - u * slope[piece + 1]);
  }
  return curve;
}

}  // namespace kinegraph
