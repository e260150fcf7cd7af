#include "nodes/cartoon/planted_limbs.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {
namespace {

constexpr double fade_seconds = 0.12;

// How far along its limb a sub-joint is, as part of the way from the group's upper end to `joint`: 1 at and
// below it.
std::vector<double> nearness(const Skeleton& skeleton, const SubJoints& sub, int joint) {
  std::vector<double> near(sub.all.size());
  for (std::size_t i = 0; i < near.size(); ++i)
    if (skeleton.is_below(sub.all[i].joint, joint)) near[i] = 1;
  for (const auto& group : sub.groups) {
    const auto end = std::find(group.begin(), group.end(), joint);
    if (end == group.end()) continue;
    double total = 0;
    for (auto k = group.begin() + 1; k < group.end() && k <= end; ++k) total += skeleton.link_length(*k);
    if (!(total > 0)) continue;
    double way = 0;
    for (auto k = group.begin(); k < end; ++k) {
      const double link = skeleton.link_length(*(k + 1));
      const int first = sub.first[*k];
      for (int l = 0; l < sub.all[first].count; ++l)
        near[first + l] = (way + sub.all[first + l].part() * link) / total;
      way += link;
    }
  }
  return near;
}

}  // namespace

double smoothest_step(double u) {
  if (u <= 0) return 0;
  if (u >= 1) return 1;
  return u * u * u * (10 + u * (6 * u - 15));
}

std::vector<double> faded(const std::vector<bool>& flags, double fade) {
  std::vector<double> out(flags.size());
  const std::vector<Run> runs = runs_of(flags);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto& run = runs[r];
    for (std::size_t t = run.start; t < run.end; ++t) out[t] = 1;
    const double gap_before = r > 0 ? static_cast<double>(run.start - runs[r - 1].end + 1) : fade;
    const double gap_after =
        r + 1 < runs.size() ? static_cast<double>(runs[r + 1].start - run.end + 1) : fade;
    const double before = std::min(fade, gap_before), after = std::min(fade, gap_after);
    for (std::size_t t = run.start; t-- > 0;) {
      const double away = static_cast<double>(run.start - t);
      if (away >= before) break;
      out[t] = 1 - (1 - out[t]) * (1 - smoothest_step(1 - away / before));
    }
    for (std::size_t t = run.end; t < flags.size(); ++t) {
      const double away = static_cast<double>(t + 1 - run.end);
      if (away >= after) break;
      out[t] = 1 - (1 - out[t]) * (1 - smoothest_step(1 - away / after));
    }
  }
  return out;
}

std::vector<std::vector<double>> swing_left(const Motion& motion, const SubJoints& sub,
                                            const Contacts& contacts, const std::vector<int>& joints) {
  std::vector<std::vector<double>> left(sub.all.size());
  const Skeleton& skeleton = motion.skeleton();
  for (std::size_t p = 0; p < contacts.points.size(); ++p) {
    const FootPoint& point = contacts.points[p];
    const int joint = joints[p];
    if (joint < 0 || runs_of(point.planted).empty()) continue;
    std::vector<bool> planted = point.planted;
    planted.resize(motion.frames());
    const std::vector<double> held = faded(planted, fade_seconds * motion.fps());
    const std::vector<double> near = nearness(skeleton, sub, joint);
    for (std::size_t i = 0; i < sub.all.size(); ++i) {
      if (near[i] == 0) continue;
      if (left[i].empty()) left[i].assign(motion.frames(), 1.0);
      for (std::size_t t = 0; t < motion.frames(); ++t) left[i][t] *= 1 - near[i] * held[t];
    }
  }
  return left;
}

}  // namespace kinegraph
