#include "gui/viewer/marker_links.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "gui/viewer/shown_motion.h"

namespace kinegraph {
namespace {

constexpr int most_points = 400;        // pairs of more take too long
constexpr int looks = 40;               // frames that are looked at
constexpr int a_point = 3;              // links at most that start from one
constexpr double near_by = 0.35;        // of the size, m/m: farther ones aren't linked
constexpr double steady = 0.06;         // spread of the distance over its mean
constexpr double least_steady = 0.003;  // of the size: what capture errs by

struct Pair {
  double apart = 0;
  int a = 0, b = 0;
};

}  // namespace

std::vector<std::pair<int, int>> steady_links(const ShownMotion& markers) {
  std::vector<std::pair<int, int>> links;
  if (markers.points < 2 || markers.points > most_points || markers.frames < 2) return links;
  std::vector<Pair> pairs;
  for (int a = 0; a < markers.points; ++a)
    for (int b = a + 1; b < markers.points; ++b) {
      double sum = 0, squares = 0;
      int count = 0;
      for (int k = 0; k < looks; ++k) {
        const int frame = static_cast<int>(static_cast<long long>(k) * (markers.frames - 1) / (looks - 1));
        const ShownMotion::Point3 &p = markers.at(frame, a), &q = markers.at(frame, b);
        if (std::isnan(p.x) || std::isnan(q.x)) continue;
        const double apart = std::hypot(static_cast<double>(p.x - q.x), static_cast<double>(p.y - q.y),
                                        static_cast<double>(p.z - q.z));
        sum += apart;
        squares += apart * apart;
        ++count;
      }
      if (count < looks / 4) continue;
      const double mean = sum / count, spread = std::sqrt(std::max(0.0, squares / count - mean * mean));
      if (mean < near_by * markers.size && spread < std::max(steady * mean, least_steady * markers.size))
        pairs.push_back({mean, a, b});
    }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& one, const Pair& other) {
    return std::tie(one.apart, one.a, one.b) < std::tie(other.apart, other.a, other.b);
  });
  std::vector<int> taken(static_cast<std::size_t>(markers.points), 0);
  for (const Pair& pair : pairs) {
    int &of_a = taken[static_cast<std::size_t>(pair.a)], &of_b = taken[static_cast<std::size_t>(pair.b)];
    if (of_a >= a_point || of_b >= a_point) continue;
    ++of_a;
    ++of_b;
    links.emplace_back(pair.a, pair.b);
  }
  // A few that keep together by chance are none.
  if (2 * links.size() < static_cast<std::size_t>(markers.points)) links.clear();
  return links;
}

}  // namespace kinegraph
