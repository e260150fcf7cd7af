#include "nodes/motion/fill_gaps.h"

#include <algorithm>

namespace kinegraph {

namespace {

constexpr std::size_t beside = 8;  // samples on each side that a spline goes through

// The natural cubic spline through (knots, values), at a time between two of the knots.
class Spline {
 public:
  Spline(std::vector<double> knots, std::vector<Vec3> values)
      : knots_(std::move(knots)), values_(std::move(values)), bends_(knots_.size()) {
    // Second derivatives m_i: h_{i-1} m_{i-1} + 2 (h_{i-1} + h_i) m_i + h_i m_{i+1} = 6 (s_i - s_{i-1}),
    // m = 0 at both ends; by elimination.
    const std::size_t n = knots_.size();
    std::vector<double> pivot(n, 1);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double before = knots_[i] - knots_[i - 1], after = knots_[i + 1] - knots_[i];
      pivot[i] = 2 * (before + after);
      bends_[i] = 6 * ((values_[i + 1] - values_[i]) / after - (values_[i] - values_[i - 1]) / before);
      if (i == 1) continue;
      const double factor = before / pivot[i - 1];
      pivot[i] -= factor * before;
      bends_[i] -= factor * bends_[i - 1];
    }
    for (std::size_t i = n - 1; i-- > 1;)
      bends_[i] = (bends_[i] - (knots_[i + 1] - knots_[i]) * bends_[i + 1]) / pivot[i];
  }
  Vec3 operator()(double time) const {
    auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, time) - knots_.begin();
    const std::size_t b = static_cast<std::size_t>(after), a = b - 1;
    const double h = knots_[b] - knots_[a], u = (time - knots_[a]) / h, v = 1 - u;
    return v * values_[a] + u * values_[b] +
           h * h / 6 * ((v * v * v - v) * bends_[a] + (u * u * u - u) * bends_[b]);
  }

 private:
  std::vector<double> knots_;
  std::vector<Vec3> values_;
  std::vector<Vec3> bends_;
};

}  // namespace

std::vector<Gap> gaps_of(const Points& points, int label) {
  std::vector<Gap> gaps;
  for (std::size_t t = 0; t < points.frames; ++t) {
    if (!points.is_missing(label, t)) continue;
    if (!gaps.empty() && gaps.back().last == t) {
      ++gaps.back().last;
    } else {
      gaps.push_back({t, t + 1});
    }
  }
  return gaps;
}

std::size_t fill_gaps(Points& points, std::size_t max_gap) {
  if (points.missing.empty()) return 0;
  std::size_t filled = 0;
  bool any_left = false;
  for (int label = 0; label < static_cast<int>(points.labels.size()); ++label) {
    const std::vector<Gap> gaps = gaps_of(points, label);
    const auto track = points.track(label);
    auto known = [&](std::size_t t) { return !points.is_missing(label, t); };
    std::vector<std::pair<std::size_t, Vec3>> found;  // set after all gaps, so that none leans on another
    for (const Gap& gap : gaps) {
      const std::size_t length = gap.last - gap.first;
      if (length > max_gap || gap.first == 0 || gap.last == points.frames) {
        any_left = true;
        continue;
      }
      std::vector<std::size_t> frames;
      for (std::size_t t = gap.first, hole = 0; t-- > 0 && frames.size() < beside && hole <= max_gap;) {
        hole = known(t) ? 0 : hole + 1;
        if (known(t)) frames.push_back(t);
      }
      std::reverse(frames.begin(), frames.end());
      const std::size_t before = frames.size();
      for (std::size_t t = gap.last, hole = 0;
           t < points.frames && frames.size() - before < beside && hole <= max_gap; ++t) {
        hole = known(t) ? 0 : hole + 1;
        if (known(t)) frames.push_back(t);
      }
      std::vector<double> knots;
      std::vector<Vec3> values;
      for (std::size_t t : frames) {
        knots.push_back(static_cast<double>(t));
        values.push_back(track[t]);
      }
      const Spline spline(std::move(knots), std::move(values));
      for (std::size_t t = gap.first; t < gap.last; ++t)
        found.emplace_back(t, spline(static_cast<double>(t)));
    }
    for (const auto& [t, place] : found) {
      track.set(t, place);
      points.missing[static_cast<std::size_t>(label) * points.frames + t] = false;
    }
    filled += found.size();
  }
  if (!any_left) points.missing.clear();
  return filled;
}

}  // namespace kinegraph
