#include "nodes/gait/gait_foot.h"

#include "nodes/motion/elementary.h"

namespace kinegraph {

double variation(std::uint64_t seed, std::uint64_t channel, std::int64_t index) {
  if (seed == 0) return 0;
  // SplitMix64 (Steele et al. 2014), once over each argument.
  auto mix = [](std::uint64_t x) {
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  };
  const std::uint64_t bits = mix(mix(mix(seed) + channel) + static_cast<std::uint64_t>(index));
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

GaitFoot::GaitFoot(const GaitStyle& style, const GaitBody& body, bool left, const FootTiming& timing)
    : style_(style), body_(body), timing_(timing), left_(left) {
  flat_from_ = style.flat_from * timing.period;
  flat_to_ = style.flat_to * timing.period;
  lift_off_ = style.duty * timing.period;
  landing_rate_ = -1.5 * style.landing / flat_from_;
  push_off_rate_ = -1.6 * style.push_off / (lift_off_ - flat_to_);
}

Vec3 GaitFoot::print(std::int64_t step) const {
  const std::uint64_t side = left_ ? 0 : 100;
  const double stride = timing_.speed * timing_.period / 2;
  const double landed = timing_.start + static_cast<double>(step) * timing_.period;
  const double x = style_.step_width / 2 + 0.006 * variation(timing_.seed, side + 1, step);
  return {left_ ? x : -x, body_.ankle_height,
          timing_.speed * landed + timing_.lead + 0.02 * stride * variation(timing_.seed, side + 2, step)};
}

CoordinateState GaitFoot::stance_pitch(double t) const {
  if (t < flat_from_) return Quintic({style_.landing, landing_rate_, 0}, {}, flat_from_).at(t);
  if (t <= flat_to_) return {};
  return Quintic({}, {-style_.push_off, push_off_rate_, 0}, lift_off_ - flat_to_).at(t - flat_to_);
}

// How far the ankle moves as the sole turns about its heel (toes up) or ball (heel up); in the foot's plane.
Vec3 GaitFoot::rolled(double pitch) const {
  const bool about_heel = pitch > 0;
  // The pivot as the flat foot's ankle sees it.
  const Vec3 pivot = about_heel ? Vec3{0, -body_.ankle_height, -body_.heel_behind}
                                : Vec3{0, body_.ball_height - body_.ankle_height, body_.ball_ahead};
  return pivot - rotate(axis_angle({1, 0, 0}, -pitch), pivot);
}

// The ball, of a sole that turns about its heel; one that lands on its ball has it there already.
GaitFoot::Rolled GaitFoot::ball_from_flat(const CoordinateState& pitch) const {
  if (pitch.value <= 0) return {};
  const double y = body_.ball_height, z = body_.heel_behind + body_.ball_ahead;  // from the heel
  const SinCos turn = sin_cos(-pitch.value);
  const double up = y * turn.cos - z * turn.sin, ahead = y * turn.sin + z * turn.cos;
  const double w = -pitch.speed, a = -pitch.acceleration;
  return {{up - y, -w * ahead, -a * ahead - w * w * up}, {ahead - z, w * up, a * up - w * w * ahead}};
}

FootState GaitFoot::at(double seconds) const {
  const double cycles = (seconds - timing_.start) / timing_.period;
  const auto step = static_cast<std::int64_t>(std::floor(cycles));
  const double t = seconds - timing_.start - static_cast<double>(step) * timing_.period;
  FootState state;
  state.yaw = left_ ? style_.toe_out : -style_.toe_out;
  if (t >= lift_off_) return swinging(step, t);
  const CoordinateState pitch = stance_pitch(t);
  state.pitch = pitch.value;
  state.toe_bend = pitch.value < 0 ? -pitch.value : 0;  // the toes lie flat
  state.ankle = print(step) + rotate(about_y(state.yaw), rolled(pitch.value));
  state.heel_down = pitch.value >= 0;
  state.ball_down = pitch.value <= 0;
  return state;
}

FootState GaitFoot::swinging(std::int64_t step, double since_landing) const {
  const double length = timing_.period - lift_off_;
  const double t = since_landing - lift_off_;
  const double s = t / length;
  const CoordinateState off{-style_.push_off, push_off_rate_, 0}, on{style_.landing, landing_rate_, 0};

  // Pitch: through the middle of the swing, without overshoot there.
  const double half = length / 2;
  const double before = (style_.swing_pitch - off.value) / half,
               after = (on.value - style_.swing_pitch) / half;
  const double slope = before * after > 0 ? 2 * before * after / (before + after) : 0;
  const CoordinateState middle{style_.swing_pitch, slope, 0};
  FootState state;
  state.pitch =
      t < half ? Quintic(off, middle, half).at(t).value : Quintic(middle, on, half).at(t - half).value;

  // Toes: straight again by the middle of the swing, bent for a landing on the ball.
  const CoordinateState bent{-off.value, -off.speed, 0};
  const CoordinateState ready = on.value < 0 ? CoordinateState{-on.value, -on.speed, 0} : CoordinateState{};
  state.toe_bend =
      t < half ? Quintic(bent, {}, half).at(t).value : Quintic({}, ready, half).at(t - half).value;

  // The ball's way from where it rested to where it comes down; the ankle rides on it by the pitch.
  const Vec3 here = print(step), next = print(step + 1);
  const double yaw = left_ ? style_.toe_out : -style_.toe_out;
  const Vec3 along = rotate(about_y(yaw), {0, 0, 1});
  const Vec3 to_ball{0, body_.ball_height - body_.ankle_height, body_.ball_ahead};
  const Rolled to = ball_from_flat(on);
  auto placed = [](double at, double factor, const CoordinateState& c) {
    return CoordinateState{at + factor * c.value, factor * c.speed, factor * c.acceleration};
  };
  const std::uint64_t side = left_ ? 0 : 100;
  const double lift = style_.lift * (1 + 0.15 * variation(timing_.seed, side + 3, step));
  const Vec3 moved = next - here;
  Vec3 ball = here + rotate(about_y(yaw), to_ball);
  ball.x += Quintic({}, placed(moved.x, along.x, to.ahead), length).at(t).value;
  ball.y += Quintic({}, placed(moved.y, 1, to.up), length).at(t).value + lift * bump(s);
  ball.z += Quintic({}, placed(moved.z, along.z, to.ahead), length).at(t).value;
  ball.x += (left_ ? 1 : -1) * style_.circle * bump(s);
  state.yaw = yaw;
  state.ankle = ball - rotate(orientation(state), to_ball);
  return state;
}

Quat GaitFoot::orientation(const FootState& state) const {
  return about_y(state.yaw) * axis_angle({1, 0, 0}, -state.pitch);
}

}  // namespace kinegraph
