#include "nodes/feet/floor_clearance.h"

#include <algorithm>
#include <cmath>

#include "nodes/feet/blending.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr double most_toe_turn = pi / 4, most_foot_turn = pi / 6;

std::vector<double> plant_heights(const Contacts& contacts, std::string_view part) {
  std::vector<double> heights;
  for (const FootPoint& point : contacts.points)
    if (point.part == part) heights.insert(heights.end(), point.heights.begin(), point.heights.end());
  std::sort(heights.begin(), heights.end());
  return heights;
}

// By how much a foot may pass below the lowest place where it stands.
std::vector<double> room_below(const FootTrack& foot, double fps) {
  constexpr double rolling = 0.022, swinging = 0.005;    // m
  constexpr double rolls_for = 0.03, swings_from = 0.1;  // s from a plant
  std::vector<bool> free(foot.frames());
  for (std::size_t t = 0; t < free.size(); ++t)
    free[t] = !foot.heel.planted_at(t) && !foot.ball.planted_at(t);
  std::vector<double> room(foot.frames(), rolling);
  for (const Run& swing : runs_of(free)) {
    if (swing.start == 0 || swing.end == free.size()) continue;
    for (std::size_t t = swing.start; t < swing.end; ++t) {
      const double away = static_cast<double>(std::min(t + 1 - swing.start, swing.end - t)) / fps;
      const double u = std::clamp((away - rolls_for) / (swings_from - rolls_for), 0.0, 1.0);
      room[t] = rolling + (swinging - rolling) * u * u * (3 - 2 * u);
    }
  }
  return room;
}

std::vector<double> above_plants(const FootTrack::Part& part, double contacts_floor,
                                 std::optional<double> floor, const std::vector<double>& below,
                                 double least) {
  std::vector<double> limits(below.size(), least);
  if (part.heights.empty()) return limits;
  std::vector<double> heights = part.heights;
  std::sort(heights.begin(), heights.end());
  const double stands = floor ? *floor + heights[heights.size() / 2] - contacts_floor : heights.front();
  // On a slope or on stairs the foot comes from, and goes to, places that no plant tells of.
  constexpr double uneven = 0.06;  // m
  const bool level = floor || heights.back() - heights.front() < uneven;
  const std::vector<Run> plants = runs_of(part.planted);
  for (std::size_t t = 0; t < limits.size(); ++t)
    if (level || (t >= plants.front().start && t < plants.back().end))
      limits[t] = std::max(least, stands - below[t]);
  return limits;
}

bool any(const std::vector<double>& need) {
  return std::any_of(need.begin(), need.end(), [](double depth) { return depth > 0; });
}

// Turns that bring the far end of something rigid above a height.
class Raising {
 public:
  Raising(std::size_t frames, double most) : most_(most), along_(frames), wanted_(frames), asked_(frames) {}

  // In this frame it turns about `at` and reaches `along` from there.
  void ask(std::size_t t, Vec3 at, Vec3 along, double height) {
    wanted_[t] = height - at.y;
    along_[t] = along;
    asked_[t] = norm(along) > 0 && along.y < wanted_[t];
  }
  // World turns, none in `fixed` frames; empty where nothing was asked. What rises before and after the
  // frames that asked turns about their axes: the foot's own would swing round where it hangs.
  std::vector<Quat> turns(const std::vector<bool>& fixed, double fps, double blend) const {
    std::vector<Vec3> axes(asked_.size());
    std::vector<double> need(asked_.size(), 0.0);
    for (const Run& section : sections(static_cast<std::size_t>(blend * fps)))
      ask_together(section, axes, need);
    if (!any(need)) return {};
    const std::vector<double> rise = rise_smoothly(need, fixed, fps, blend);
    std::vector<Quat> turns(need.size());
    std::size_t before = next_asked(need, 0), after = before;  // the asking frames on both sides
    for (std::size_t t = 0; t < turns.size(); ++t) {
      if (t > after) {
        before = after;
        after = next_asked(need, t);
      }
      turns[t] = axis_angle(between(axes, before, after, t), -rise[t]);
    }
    return turns;
  }

 private:
  static std::size_t next_asked(const std::vector<double>& need, std::size_t from) {
    while (from < need.size() && need[from] <= 0) ++from;
    return from;
  }
  static Vec3 between(const std::vector<Vec3>& axes, std::size_t before, std::size_t after, std::size_t t) {
    if (after >= axes.size() || t <= before) return axes[before];
    if (dot(axes[before], axes[after]) <= 0) return axes[after - t < t - before ? after : before];
    const double u = static_cast<double>(t - before) / static_cast<double>(after - before);
    return normalized((1 - u) * axes[before] + u * axes[after]);
  }
  // Frames that ask, and short gaps between them.
  std::vector<Run> sections(std::size_t gap) const {
    std::vector<Run> all;
    for (const Run& run : runs_of(asked_)) {
      if (!all.empty() && run.start <= all.back().end + gap)
        all.back().end = run.end;
      else
        all.push_back(run);
    }
    return all;
  }
  // A section turns to one side all along: what hangs straight down, or passes there, would turn one way in
  // one frame and the other way in the next if each frame took its own shorter way up.
  void ask_together(Run section, std::vector<Vec3>& axes, std::vector<double>& need) const {
    constexpr double upright = 0.3;  // of the length: level parts under this tell too little of a direction
    Vec3 common;
    for (std::size_t t = section.start; t < section.end; ++t)
      if (asked_[t]) common += sideways(along_[t]) / norm(along_[t]);
    if (norm(common) <= 1e-6) return;
    common = normalized(common);
    for (std::size_t t = section.start; t < section.end; ++t) {
      if (!asked_[t]) continue;
      const double length = norm(along_[t]);
      Vec3 side = sideways(along_[t]) / length;
      if (dot(side, common) < 0) side = -side;
      // About this axis a positive turn takes the end down.
      axes[t] = normalized(side + std::max(0.0, upright - norm(side)) * common);
      const double ahead = along_[t].x * -axes[t].z + along_[t].z * axes[t].x;
      const double reach = std::sqrt(ahead * ahead + along_[t].y * along_[t].y);
      const double down = arc_tangent2(-along_[t].y, ahead);
      const double up = arc_sine(wanted_[t] / reach);
      need[t] = std::clamp(up + down, 0.0, most_);
    }
  }
  static Vec3 sideways(Vec3 along) { return {along.z, 0, -along.x}; }

  double most_;
  std::vector<Vec3> along_;
  std::vector<double> wanted_;  // height of the end above where it turns about, m
  std::vector<bool> asked_;
};

}  // namespace

FloorLimits floor_limits(const Contacts& contacts, const FootTrack& foot, std::optional<double> floor) {
  double ground = contacts.floor, heel = 0;
  for (const char* part : {"heel", "ball"}) {
    const std::vector<double> heights = plant_heights(contacts, part);
    if (heights.empty()) continue;
    const double usual = heights[heights.size() / 2];
    ground = std::min(ground, contacts.floor + heights.front() - usual);
    if (std::string_view(part) == "heel") heel = std::max(0.0, usual - contacts.floor);
  }
  if (floor) ground = *floor;
  const std::vector<double> below = room_below(foot, contacts.fps);
  FloorLimits limits;
  limits.heel = above_plants(foot.heel, contacts.floor, floor, below, ground + heel / 2);
  limits.ball = above_plants(foot.ball, contacts.floor, floor, below, ground);
  limits.tip = ground;
  return limits;
}

void lift_off_floor(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                    const std::vector<double>& weights, AnkleTargets& targets) {
  std::vector<double> need(foot.frames(), 0.0);
  for (std::size_t t = 0; t < foot.frames(); ++t) {
    if (targets.held[t]) continue;
    const auto depth = [&](const std::vector<Vec3>& from_ankle, double limit) {
      if (from_ankle.empty()) return 0.0;
      return limit - (foot.ankle[t] + targets.move[t] + rotate(targets.turn[t], from_ankle[t])).y;
    };
    need[t] = std::max({0.0, depth(foot.heel.from_ankle, limits.heel[t]),
                        depth(foot.ball.from_ankle, limits.ball[t]), depth(foot.tip_from_ankle, limits.tip)});
  }
  if (!any(need)) return;
  const std::vector<double> lift = rise_smoothly(need, targets.held, fps, blend);
  for (std::size_t t = 0; t < foot.frames(); ++t) targets.move[t].y += weights[t] * lift[t];
}

void raise_heels(const FootTrack& foot, const PlantPositions& places, const FloorLimits& limits, double fps,
                 double blend, AnkleTargets& targets) {
  if (foot.ball.from_ankle.empty()) return;
  Raising raising(foot.frames(), most_foot_turn);
  std::vector<bool> stands(foot.frames());
  for (std::size_t t = 0; t < foot.frames(); ++t) {
    stands[t] = foot.heel.planted_at(t) || places.steady[t];
    if (stands[t] || !foot.ball.planted_at(t)) continue;
    const Vec3 heel = foot.heel.from_ankle.empty() ? Vec3{} : foot.heel.from_ankle[t];
    raising.ask(t, places.ball[t], rotate(targets.turn[t], heel - foot.ball.from_ankle[t]), limits.heel[t]);
  }
  const std::vector<Quat> turns = raising.turns(stands, fps, blend);
  for (std::size_t t = 0; t < turns.size(); ++t) targets.turn[t] = turns[t] * targets.turn[t];
}

void raise_balls(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                 const std::vector<double>& weights, AnkleTargets& targets) {
  if (foot.ball.from_ankle.empty()) return;
  Raising raising(foot.frames(), most_foot_turn);
  for (std::size_t t = 0; t < foot.frames(); ++t)
    if (!targets.held[t])
      raising.ask(t, foot.ankle[t] + targets.move[t], rotate(targets.turn[t], foot.ball.from_ankle[t]),
                  limits.ball[t]);
  const std::vector<Quat> turns = raising.turns(targets.held, fps, blend);
  for (std::size_t t = 0; t < turns.size(); ++t)
    targets.turn[t] = slerp(weights[t], Quat{}, turns[t]) * targets.turn[t];
}

std::vector<Quat> toe_turns(const FootTrack& foot, const FloorLimits& limits, double fps, double blend,
                            const AnkleTargets& targets) {
  if (foot.tip_from_ankle.empty() || foot.toe_from_ankle.empty()) return {};
  Raising raising(foot.frames(), most_toe_turn);
  for (std::size_t t = 0; t < foot.frames(); ++t)
    raising.ask(t, foot.ankle[t] + targets.move[t] + rotate(targets.turn[t], foot.toe_from_ankle[t]),
                rotate(targets.turn[t], foot.tip_from_ankle[t] - foot.toe_from_ankle[t]), limits.tip);
  return raising.turns(std::vector<bool>(foot.frames(), false), fps, blend);
}

}  // namespace kinegraph
