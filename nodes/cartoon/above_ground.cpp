#include "nodes/cartoon/above_ground.h"

#include <algorithm>

namespace kinegraph {

std::vector<double> lift_above_ground(const FootPoint& point, const WorldMotion& world, int joint,
                                      double leg) {
  std::vector<double> lift(world.frames());
  const std::vector<Run> runs = runs_of(point.planted);
  if (runs.empty() || point.heights.size() != runs.size() || !(leg > 0)) return lift;
  const double softness = 0.025 * leg;
  std::size_t next = 0;  // the first plant that isn't over
  for (std::size_t t = 0; t < lift.size(); ++t) {
    while (next < runs.size() && t >= runs[next].end) ++next;
    if (next < runs.size() && t >= runs[next].start) continue;
    const double before = point.heights[next > 0 ? next - 1 : 0],
                 after = point.heights[std::min(next, runs.size() - 1)];
    const double below = std::min(before, after) - point_at(world, joint, point.local, t).y;
    if (below > 0) lift[t] = below * below / (below + softness);
  }
  return lift;
}

}  // namespace kinegraph
