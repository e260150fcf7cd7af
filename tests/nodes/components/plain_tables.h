// Components and their motions as tables of numbers, by plain loops that share nothing with the program: what
// tests on real clips compare with.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "nodes/components/components.h"
#include "nodes/motion/points.h"
#include "tests/main_job/independent_measures.h"

namespace kinegraph::plain {

// Numbers by component or channel, and frame.
using Table = std::vector<std::vector<double>>;

inline Table table_of(const Rows& rows, std::size_t start, std::size_t end) {
  Table out;
  for (std::size_t i = 0; i < rows.rows; ++i) out.emplace_back(rows.row(i) + start, rows.row(i) + end);
  return out;
}
inline Table u_of(const Components& c, std::size_t segment) {
  return table_of(c.signals, c.segments[segment].start, c.segments[segment].end);
}
// E{x} + P A u.
inline Table x_of(const Components& c, const Table& u) {
  Table x(c.mean.size(), std::vector<double>(u[0].size()));
  for (std::size_t d = 0; d < x.size(); ++d)
    for (std::size_t t = 0; t < u[0].size(); ++t) {
      x[d][t] = c.mean[d];
      for (std::size_t i = 0; i < u.size(); ++i) x[d][t] += c.mixing(d, i) * u[i][t];
    }
  return x;
}
// The channels that edited points say: places from the root, or as they are.
inline Table channels_of(const Points& points, bool of_motions) {
  Table x(3 * points.labels.size(), std::vector<double>(points.frames));
  for (int i = 0; i < static_cast<int>(points.labels.size()); ++i)
    for (std::size_t t = 0; t < points.frames; ++t) {
      const Vec3 at = points.track(i)[t] - (of_motions ? points.track(0)[t] : Vec3{});
      for (int axis = 0; axis < 3; ++axis)
        x[3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(axis)][t] = at[axis];
    }
  return x;
}
// A motion's joints with root and heading taken out, by the tests' own kinematics; with `bones` given, its
// links are as long as theirs (joints of the same names).
inline Table channels_of(const Motion& motion, const Skeleton* bones = nullptr) {
  const Skeleton& skeleton = motion.skeleton();
  auto places = independent::positions_of(motion);
  const auto psi = independent::heading_of(motion).psi;
  Table x(3 * places.size(), std::vector<double>(motion.frames()));
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    std::vector<Vec3> at(places.size());
    for (std::size_t j = 1; j < places.size(); ++j) {
      const auto parent = static_cast<std::size_t>(skeleton.joints[j].parent);
      const Vec3 link = places[j][t] - places[parent][t];
      double scale = 1;
      if (bones && norm(link) > 1e-9)
        scale = norm(bones->joints[static_cast<std::size_t>(bones->find(skeleton.joints[j].name))].offset) /
                norm(link);
      at[j] = at[parent] + scale * link;
    }
    const double c = std::cos(psi[t]), s = std::sin(psi[t]);
    for (std::size_t j = 0; j < places.size(); ++j) {
      x[3 * j][t] = c * at[j].x - s * at[j].z;
      x[3 * j + 1][t] = at[j].y;
      x[3 * j + 2][t] = s * at[j].x + c * at[j].z;
    }
  }
  return x;
}
inline double farthest(const Table& a, const Table& b) {
  if (a.size() != b.size() || a[0].size() != b[0].size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t t = 0; t < a[i].size(); ++t) worst = std::max(worst, std::fabs(a[i][t] - b[i][t]));
  return worst;
}
inline double linear(const std::vector<double>& series, double time) {
  const auto low = std::min(static_cast<std::size_t>(time), series.size() - 1);
  const double part = time - static_cast<double>(low);
  return part > 0 ? (1 - part) * series[low] + part * series[low + 1] : series[low];
}

// The time warp found once more. The path is the one of the least sum of squared differences
// in which every frame of the longer clip shows one of the shorter, which advances by 0 to 3 and is held for
// at most 3 frames (or more where the lengths need it).
struct Path {
  bool a_is_clock = false;
  std::vector<std::size_t> shown;  // of the shorter, at every frame of the longer
};
inline Path path_between(const Table& a, const Table& b) {
  Path path;
  path.a_is_clock = a[0].size() >= b[0].size();
  const Table &clock = path.a_is_clock ? a : b, &other = path.a_is_clock ? b : a;
  const std::size_t rows = clock[0].size(), columns = other[0].size();
  const std::size_t step = std::max<std::size_t>(3, (rows + columns - 1) / columns + 1);
  const double far = std::numeric_limits<double>::infinity();
  // cost[column][held]; `from`: of a frame shown anew, by how much it advanced and how long the one before
  // had been held.
  std::vector<std::vector<double>> cost(columns, std::vector<double>(step, far)), next;
  std::vector<std::uint16_t> from(rows * columns);
  const auto apart = [&](std::size_t r, std::size_t k) {
    double sum = 0;
    for (std::size_t d = 0; d < clock.size(); ++d) {
      const double e = clock[d][r] - other[d][k];
      sum += e * e;
    }
    return sum;
  };
  cost[0][0] = apart(0, 0);
  for (std::size_t r = 1; r < rows; ++r) {
    next.assign(columns, std::vector<double>(step, far));
    for (std::size_t k = 0; k < columns; ++k) {
      const double here = apart(r, k);
      for (std::size_t held = 1; held < step; ++held) next[k][held] = cost[k][held - 1] + here;
      for (std::size_t advance = 1; advance <= std::min(step, k); ++advance)
        for (std::size_t held = 0; held < step; ++held)
          if (cost[k - advance][held] + here < next[k][0]) {
            next[k][0] = cost[k - advance][held] + here;
            from[r * columns + k] = static_cast<std::uint16_t>(advance * step + held);
          }
    }
    cost = next;
  }
  std::size_t k = columns - 1;
  std::size_t held =
      static_cast<std::size_t>(std::min_element(cost[k].begin(), cost[k].end()) - cost[k].begin());
  path.shown.resize(rows);
  for (std::size_t r = rows; r-- > 0;) {
    path.shown[r] = k;
    if (r == 0) break;
    if (held > 0) {
      --held;
      continue;
    }
    held = from[r * columns + k] % step;
    k -= from[r * columns + k] / step;
  }
  return path;
}

// The time of each frame of the shorter in frames of the longer: the middle of the rows that show it, between
// those of its neighbours where none does.
inline std::vector<double> times_of_shown(const Path& path, std::size_t frames) {
  std::vector<double> sum(frames), count(frames), out(frames);
  for (std::size_t r = 0; r < path.shown.size(); ++r)
    sum[path.shown[r]] += static_cast<double>(r), count[path.shown[r]] += 1;
  for (std::size_t f = 0; f < frames; ++f) {
    std::size_t low = f, high = f;
    while (count[low] == 0) --low;
    while (count[high] == 0) ++high;
    const double a = sum[low] / count[low], b = sum[high] / count[high];
    out[f] = low == high ? a : a + (b - a) * static_cast<double>(f - low) / static_cast<double>(high - low);
  }
  return out;
}
// The other way: for each frame of the longer the time in frames of the shorter, on the straight lines
// between those middles; held beyond the first and the last.
inline std::vector<double> times_of_clock(const std::vector<double>& middles, std::size_t rows) {
  std::vector<double> out(rows);
  for (std::size_t r = 0; r < rows; ++r) {
    const auto x = static_cast<double>(r);
    std::size_t high = 0;
    while (high < middles.size() && middles[high] < x) ++high;
    if (high == 0)
      out[r] = 0;
    else if (high == middles.size())
      out[r] = static_cast<double>(middles.size() - 1);
    else
      out[r] = static_cast<double>(high - 1) + (x - middles[high - 1]) / (middles[high] - middles[high - 1]);
  }
  return out;
}
// At every frame of a the time in b, or of b in a.
inline std::vector<double> clock_map(const Path& path, std::size_t a_frames, std::size_t b_frames,
                                     bool b_of_a) {
  const std::size_t rows = path.a_is_clock ? a_frames : b_frames,
                    shorter = path.a_is_clock ? b_frames : a_frames;
  const auto middles = times_of_shown(path, shorter);
  return path.a_is_clock == b_of_a ? times_of_clock(middles, rows) : middles;
}

}  // namespace kinegraph::plain
