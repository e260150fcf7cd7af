#include "nodes/feet/floor_clearance.h"

#include <algorithm>
#include <cmath>

#include "nodes/feet/blending.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr double most_toe_turn = pi / 4;

std::vector<double> plant_heights(const Contacts& contacts, std::string_view part) {
  std::vector<double> heights;
  for (const FootPoint& point : contacts.points)
    if (point.part == part) heights.insert(heights.end(), point.heights.begin(), point.heights.end());
  std::sort(heights.begin(), heights.end());
  return heights;
}

bool any(const std::vector<double>& need) {
  return std::any_of(need.begin(), need.end(), [](double depth) { return depth > 0; });
}

}  // namespace

FloorLimits floor_limits(const Contacts& contacts, std::optional<double> floor) {
  double ground = contacts.floor, heel = 0;
  for (const char* part : {"heel", "ball"}) {
    const std::vector<double> heights = plant_heights(contacts, part);
    if (heights.empty()) continue;
    const double usual = heights[heights.size() / 2];
    ground = std::min(ground, contacts.floor + heights.front() - usual);
    if (std::string_view(part) == "heel") heel = std::max(0.0, usual - contacts.floor);
  }
  if (floor) ground = *floor;
  return {ground + heel / 2, ground, ground};
}

void lift_off_floor(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                    AnkleTargets& targets) {
  std::vector<double> need(foot.frames(), 0.0);
  for (std::size_t t = 0; t < foot.frames(); ++t) {
    if (targets.held[t]) continue;
    const auto depth = [&](const std::vector<Vec3>& from_ankle, double limit) {
      if (from_ankle.empty()) return 0.0;
      return limit - (foot.ankle[t] + targets.move[t] + rotate(targets.turn[t], from_ankle[t])).y;
    };
    need[t] = std::max({0.0, depth(foot.heel.from_ankle, limits.heel),
                        depth(foot.ball.from_ankle, limits.ball), depth(foot.tip_from_ankle, limits.tip)});
  }
  if (!any(need)) return;
  const std::vector<double> lift = rise_smoothly(need, targets.held, fps, blend);
  for (std::size_t t = 0; t < foot.frames(); ++t) targets.move[t].y += lift[t];
}

std::vector<Quat> toe_turns(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                            const AnkleTargets& targets) {
  if (foot.tip_from_ankle.empty() || foot.toe_from_ankle.empty()) return {};
  std::vector<double> need(foot.frames(), 0.0);
  std::vector<Vec3> axis(foot.frames());
  for (std::size_t t = 0; t < foot.frames(); ++t) {
    const Vec3 toe = foot.ankle[t] + targets.move[t] + rotate(targets.turn[t], foot.toe_from_ankle[t]);
    const Vec3 along = rotate(targets.turn[t], foot.tip_from_ankle[t] - foot.toe_from_ankle[t]);
    const double length = norm(along);
    const Vec3 side{along.z, 0, -along.x};
    if (length <= 0 || norm(side) <= 1e-6 * length) continue;
    // About this axis a positive turn takes the tip down.
    axis[t] = normalized(side);
    const double wanted = (limits.tip - toe.y) / length;
    if (along.y >= wanted * length) continue;
    const auto elevation = [](double sine) { return pi / 2 - arc_cosine(std::clamp(sine, -1.0, 1.0)); };
    need[t] = std::min(elevation(wanted) - elevation(along.y / length), most_toe_turn);
  }
  if (!any(need)) return {};
  const std::vector<double> rise = rise_smoothly(need, std::vector<bool>(foot.frames(), false), fps, blend);
  std::vector<Quat> turns(foot.frames());
  for (std::size_t t = 0; t < foot.frames(); ++t)
    if (norm(axis[t]) > 0) turns[t] = axis_angle(axis[t], -rise[t]);
  return turns;
}

}  // namespace kinegraph
