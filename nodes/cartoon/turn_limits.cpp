#include "nodes/cartoon/turn_limits.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

// At 120 frames a second, with a little left for what later nodes and files round.
constexpr double twist_a_second = 14.9 * 120 / degrees_per_radian;
constexpr double twist_departure_a_second = 5 * 120 / degrees_per_radian;
constexpr double turn_departure_a_second = 30 * 120 / degrees_per_radian;

}  // namespace

TurnLimits turn_limits(double fps) {
  const auto a_frame = [fps](double a_second) { return std::min(a_second / fps, pi); };
  return {a_frame(twist_a_second), a_frame(twist_departure_a_second), a_frame(turn_departure_a_second)};
}

HalfTwist::HalfTwist(Quat rotation, Vec3 axis)
    : cosine(rotation.w), sine(dot(axis, Vec3{rotation.x, rotation.y, rotation.z})) {
  if (cosine < 0) {
    cosine = -cosine;
    sine = -sine;
  }
}

HalfTwist::HalfTwist(double angle)
    : cosine(kinegraph::cosine(0.5 * angle)), sine(kinegraph::sine(0.5 * angle)) {}

double HalfTwist::angle() const {
  return 2 * arc_tangent2(sine, cosine);
}

HalfTwist HalfTwist::beyond(HalfTwist other) const {
  HalfTwist left = *this;
  left.cosine = cosine * other.cosine + sine * other.sine;
  left.sine = sine * other.cosine - cosine * other.sine;
  if (left.cosine < 0) {
    left.cosine = -left.cosine;
    left.sine = -left.sine;
  }
  return left;
}

bool HalfTwist::exceeds(HalfTwist other) const {
  return std::fabs(sine) * other.cosine > std::fabs(other.sine) * cosine;
}

std::vector<double> with_steps_between(std::span<const double> values, std::span<const double> least,
                                       std::span<const double> most) {
  const std::size_t count = values.size();
  std::vector<double> low(values.begin(), values.end()), high = low;
  for (std::size_t t = 1; t < count; ++t) {
    low[t] = std::max(low[t], low[t - 1] + least[t]);
    high[t] = std::min(high[t], high[t - 1] + most[t]);
  }
  for (std::size_t t = count; t-- > 1;) {
    low[t - 1] = std::max(low[t - 1], low[t] - most[t]);
    high[t - 1] = std::min(high[t - 1], high[t] - least[t]);
  }
  for (std::size_t t = 0; t < count; ++t) low[t] = 0.5 * (low[t] + high[t]);
  return low;
}

std::vector<Quat> with_turns_within(std::span<const Quat> turns, std::span<const double> most) {
  const std::size_t count = turns.size();
  const auto follow = [](Quat from, Quat to, double most_turn) {
    // Most are near enough: cos(a/2) <= 1 − a²/8 + a⁴/384.
    const double square = most_turn * most_turn;
    if (std::fabs(dot(from, to)) > 1 - square / 8 + square * square / 384 + 1e-12) return to;
    const double angle = turn(from, to);
    return angle > most_turn ? slerp(most_turn / angle, from, to) : to;
  };
  std::vector<Quat> forward(turns.begin(), turns.end()), backward = forward;
  for (std::size_t t = 1; t < count; ++t) forward[t] = follow(forward[t - 1], turns[t], most[t]);
  for (std::size_t t = count; t-- > 1;) backward[t - 1] = follow(backward[t], turns[t - 1], most[t]);
  // The middle of two that keep within may go a little faster than either where they are far apart.
  for (std::size_t t = 0; t < count; ++t) {
    const Quat middle = forward[t] == backward[t] ? forward[t] : slerp(0.5, forward[t], backward[t]);
    forward[t] = t > 0 ? follow(forward[t - 1], middle, most[t]) : middle;
  }
  return forward;
}

void limit_twist(Vec3 axis, std::span<const InputTwist> inputs, const TurnLimits& limits,
                 QuatTrack orientations) {
  const std::size_t frames = orientations.w.size();
  const double quick = cosine(0.5 * limits.twist);
  const HalfTwist limit(limits.twist);
  const auto step = [&](std::size_t t) {
    return HalfTwist(inverse(orientations[t - 1]) * orientations[t], axis);
  };
  const auto input_step = [](const InputTwist& input, std::size_t t) {
    return HalfTwist(inverse(input.orientation[t - 1]) * input.orientation[t], input.axis);
  };
  bool spins = false;
  for (std::size_t t = 1; t < frames && !spins; ++t) {
    if (std::fabs(dot(orientations[t - 1], orientations[t])) >= quick) continue;
    const HalfTwist is = step(t);
    spins = is.exceeds(limit) && std::none_of(inputs.begin(), inputs.end(), [&](const InputTwist& input) {
              return !is.exceeds(input_step(input, t));
            });
  }
  if (!spins) return;
  std::vector<double> twist(frames), least(frames), most(frames);
  for (std::size_t t = 1; t < frames; ++t) {
    twist[t] = twist[t - 1] + step(t).angle();
    most[t] = limits.twist;
    for (const InputTwist& input : inputs)
      most[t] = std::max(most[t], std::fabs(input_step(input, t).angle()));
    least[t] = -most[t];
  }
  const std::vector<double> held = with_steps_between(twist, least, most);
  for (std::size_t t = 0; t < frames; ++t)
    if (held[t] != twist[t])
      orientations.set(t, normalized(orientations[t] * axis_angle(axis, held[t] - twist[t])));
}

}  // namespace kinegraph
