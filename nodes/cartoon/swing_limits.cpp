#include "nodes/cartoon/swing_limits.h"

#include <algorithm>
#include <cmath>

#include "nodes/cartoon/planted_limbs.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

// Of the still link's length, or of that at rest, if shorter, what a swung one has along the still one at
// least, and half of the width in which it comes to that.
constexpr double least_along = 0.2, soft = 0.3;

constexpr double at_ease = 0.5;  // of what the link may turn, how fast its swing does at most

double angle_between(Vec3 a, Vec3 b) {
  return arc_tangent2(norm(cross(a, b)), dot(a, b));
}

Vec3 any_across(Vec3 axis) {
  return normalized(cross(axis, std::fabs(axis.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
}

// `across`, at right angles to `from`, turned with it to `to`; unit vectors.
Vec3 carried(Vec3 across, Vec3 from, Vec3 to) {
  const double sum = 1 + dot(from, to);
  if (sum < 1e-9) return any_across(to);
  const Vec3 there = across - (dot(to, across) / sum) * (from + to);
  return normalized(there - dot(there, to) * to);
}

// Where a swing points as seen along its still link: the angle between, in the direction across.
struct Aim {
  double x = 0, y = 0;
  double size() const { return std::sqrt(x * x + y * y); }
};
Aim operator-(Aim a, Aim b) {
  return {a.x - b.x, a.y - b.y};
}

Aim aim_of(Vec3 swung, Vec3 axis, Vec3 across) {
  const double along = dot(swung, axis), x = dot(swung, across), y = dot(swung, cross(axis, across));
  const double aside = std::sqrt(x * x + y * y);
  if (!(aside > 0)) return {};
  const double part = arc_tangent2(aside, along) / aside;
  return {part * x, part * y};
}

Vec3 direction_of(Aim aim, Vec3 axis, Vec3 across) {
  const double angle = aim.size();
  if (!(angle > 0)) return axis;
  const SinCos part = sin_cos(angle);
  return part.cos * axis + (part.sin / angle) * (aim.x * across + aim.y * cross(axis, across));
}

Vec3 without_back(Vec3 still, Vec3 axis, Vec3 swung, double rest) {
  const double length = std::min(norm(still), rest), width = soft * length,
               over = dot(swung, axis) - least_along * length;
  if (over >= width) return swung;
  const double held = over > -width ? (over + width) * (over + width) / (4 * width) : 0;
  return swung + (held - over) * axis;
}

// Midway between following forwards and backwards. False: nothing is too fast.
bool hold_steps(std::vector<Aim>& aims, std::span<const double> most) {
  const auto follow = [](Aim from, Aim to, double step) {
    const double far = (to - from).size();
    return far > step ? Aim{from.x + step / far * (to.x - from.x), from.y + step / far * (to.y - from.y)}
                      : to;
  };
  bool fast = false;
  for (std::size_t t = 1; t < aims.size() && !fast; ++t) fast = (aims[t] - aims[t - 1]).size() > most[t];
  if (!fast) return false;
  std::vector<Aim> backward = aims;
  for (std::size_t t = aims.size(); t-- > 1;) backward[t - 1] = follow(backward[t], backward[t - 1], most[t]);
  for (std::size_t t = 1; t < aims.size(); ++t) aims[t] = follow(aims[t - 1], aims[t], most[t]);
  for (std::size_t t = 0; t < aims.size(); ++t)
    aims[t] = {0.5 * (aims[t].x + backward[t].x), 0.5 * (aims[t].y + backward[t].y)};
  return true;
}

}  // namespace

double swing_step(Vec3 still_before, Vec3 swung_before, Vec3 still, Vec3 swung) {
  const Vec3 from = normalized(still_before), to = normalized(still), across = any_across(from);
  return (aim_of(swung, to, carried(across, from, to)) - aim_of(swung_before, from, across)).size();
}

double swing_room(double most, double own) {
  return std::clamp(most - own, 0.0, at_ease * most);
}

bool points_back(Vec3 still, Vec3 swung, double rest) {
  const double square = dot(still, still), along = dot(still, swung), least = least_along + soft;
  if (!(along > 0) || square == 0) return true;
  return along < least * square && along * along < least * least * (rest * rest) * square;
}

std::vector<Vec3> hold_swing(std::span<const Vec3> still, std::span<const Vec3> swung,
                             std::span<const double> most, double rest, double fade) {
  const std::size_t frames = still.size();
  std::vector<double> room(frames);  // what the swing may turn
  std::vector<bool> free(frames);
  double quick = 0, quick_of = -1;  // cosine² of the turn of the still link up to which there is all the room
  for (std::size_t t = 1; t < frames; ++t) {
    if (quick_of != most[t]) {
      quick_of = most[t];
      const double turn = std::min((1 - at_ease) * quick_of, pi / 2);
      quick = cosine(turn) * cosine(turn);
    }
    const Vec3 before = still[t - 1], now = still[t];
    const double along = dot(before, now);
    if (along > 0 && along * along > quick * (dot(before, before) * dot(now, now))) {
      room[t] = swing_room(most[t], 0);
      continue;
    }
    const double own = angle_between(before, now);
    room[t] = swing_room(most[t], own);
    if (own > most[t]) free[t - 1] = free[t] = true;
  }
  for (std::size_t t = 0; t < frames; ++t)
    if (!(dot(still[t], still[t]) > 0)) free[t] = true;
  const std::vector<double> away = faded(free, fade);
  std::vector<Vec3> out(swung.begin(), swung.end()), axes(frames), across(frames);
  std::vector<Aim> aims(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    axes[t] = normalized(still[t]);
    if (axes[t] == Vec3{}) axes[t] = t > 0 ? axes[t - 1] : Vec3{0, 1, 0};
    across[t] = t > 0 ? carried(across[t - 1], axes[t - 1], axes[t]) : any_across(axes[t]);
    if (away[t] > 0) out[t] = still[t] + (1 - away[t]) * (swung[t] - still[t]);
    out[t] = without_back(still[t], axes[t], out[t], rest);
    aims[t] = aim_of(out[t], axes[t], across[t]);
  }
  const std::vector<Aim> wished = aims;
  if (!hold_steps(aims, room)) return out;
  for (std::size_t t = 0; t < frames; ++t)
    if ((aims[t] - wished[t]).size() > 0) out[t] = norm(out[t]) * direction_of(aims[t], axes[t], across[t]);
  return out;
}

}  // namespace kinegraph
