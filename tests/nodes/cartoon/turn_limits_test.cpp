#include "nodes/cartoon/turn_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/cartoon/link_turns.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

// Orientations with tracks over them.
struct Turned {
  explicit Turned(std::size_t frames) : data(4 * frames), count(frames) {}
  QuatTrack track() {
    double* at = data.data();
    return {{at, count}, {at + count, count}, {at + 2 * count, count}, {at + 3 * count, count}};
  }
  ConstQuatTrack fixed() {
    const QuatTrack t = track();
    return {t.x, t.y, t.z, t.w};
  }
  std::vector<double> data;
  std::size_t count;
};

struct Placed {
  explicit Placed(std::vector<Vec3> points) : count(points.size()), data(3 * points.size()) {
    const Vec3Track out = track();
    for (std::size_t t = 0; t < count; ++t) out.set(t, points[t]);
  }
  Vec3Track track() {
    double* at = data.data();
    return {{at, count}, {at + count, count}, {at + 2 * count, count}};
  }
  ConstVec3Track fixed() {
    const Vec3Track t = track();
    return {t.x, t.y, t.z};
  }
  std::size_t count;
  std::vector<double> data;
};

TEST(TurnLimits, AreAFramesShareOfASecondsTurn) {
  EXPECT_NEAR(turn_limits(120).twist * degrees_per_radian, 15, 0.2);
  EXPECT_NEAR(turn_limits(60).twist, 2 * turn_limits(120).twist, 1e-12);
  EXPECT_LE(turn_limits(1).twist, pi);
}

TEST(HalfTwist, IsTheTwistOfTheSwingTwistDecomposition) {
  const Vec3 axis = normalized(Vec3{0.3, -0.8, 0.5});
  const Vec3 across = normalized(cross(axis, Vec3{1, 0, 0}));
  for (double angle : {-2.5, -0.3, 0.0, 1.0, 3.0}) {
    const Quat q = axis_angle(across, 1.2) * axis_angle(axis, angle);
    EXPECT_NEAR(HalfTwist(q, axis).angle(), angle, 1e-12);
    EXPECT_NEAR(HalfTwist(-q, axis).angle(), angle, 1e-12);
    EXPECT_NEAR(HalfTwist(q, axis).beyond(HalfTwist(0.1)).angle(), angle - 0.1, 1e-12);
    EXPECT_EQ(HalfTwist(q, axis).exceeds(HalfTwist(0.5)), std::fabs(angle) > 0.5);
  }
}

TEST(WithStepsBetween, SpreadsAJumpHalfBeforeAndHalfAfter) {
  const std::vector<double> jump{0, 0, 0, 0, 4, 4, 4, 4}, least(8, -1.0), most(8, 1.0);
  const std::vector<double> held = with_steps_between(jump, least, most);
  for (std::size_t t = 1; t < 8; ++t) EXPECT_LE(std::fabs(held[t] - held[t - 1]), 1 + 1e-12) << t;
  EXPECT_NEAR(held[3] + held[4], 4, 1e-12);  // as far from the one end as from the other
  EXPECT_EQ(held[0], 0);
  EXPECT_EQ(held[7], 4);
  const std::vector<double> slow{0, 0.5, 1, 1.5, 1, 0.5, 0, 0};
  EXPECT_EQ(with_steps_between(slow, least, most), slow);
}

TEST(WithTurnsWithin, NeverTurnsFaster) {
  std::vector<Quat> turns;
  for (int t = 0; t < 40; ++t)
    turns.push_back(t < 20 ? axis_angle({1, 0, 0}, 0.02 * t)
                           : axis_angle(normalized(Vec3{1, 3, 1}), 2.8 - 0.01 * t));
  const std::vector<double> most(40, 0.2);
  const auto held = with_turns_within(turns, most);
  for (std::size_t t = 1; t < 40; ++t) EXPECT_LE(turn(held[t - 1], held[t]), 0.2 + 1e-9) << t;
  EXPECT_LT(turn(held[0], turns[0]), 1e-9);
  EXPECT_LT(turn(held[39], turns[39]), 1e-9);
}

TEST(LimitTwist, HoldsTwistToItsLimitOrTheInputs) {
  const Vec3 axis{0, 1, 0};
  const TurnLimits limits = turn_limits(120);
  for (bool input_jumps : {false, true}) {
    Turned out(30), input(30);
    for (std::size_t t = 0; t < 30; ++t) {
      const Quat swing = axis_angle({1, 0, 0}, 0.05 * static_cast<double>(t));
      out.track().set(t, swing * axis_angle(axis, t < 15 ? 0 : 1.5));
      input.track().set(t, axis_angle(axis, input_jumps && t >= 15 ? 1.5 : 0));
    }
    const std::vector<double> as_it_was = out.data;
    const InputTwist inputs[] = {{input.fixed(), axis}};
    limit_twist(axis, inputs, limits, out.track());
    if (input_jumps) {
      EXPECT_EQ(out.data, as_it_was);
      continue;
    }
    for (std::size_t t = 1; t < 30; ++t)
      EXPECT_LE(std::fabs(HalfTwist(inverse(out.fixed()[t - 1]) * out.fixed()[t], axis).angle()),
                limits.twist + 1e-9);
    EXPECT_NEAR(HalfTwist(out.fixed()[29], axis).angle(), 1.5, 1e-9);
  }
}

TEST(AimLink, HoldsTheSpinOfALinkThatPassesTheOppositeOfWhatItWas) {
  // The old link hangs; the new one swings over the top, a little beside it: its smallest turn spins there.
  std::vector<Vec3> zero(60), down(60, Vec3{0, -1, 0}), over;
  for (int t = 0; t < 60; ++t) {
    const double angle = 0.05 * (t - 30);
    over.push_back({std::sin(angle), std::cos(angle), 0.02});
  }
  Placed from(zero), old_to(down), to(over);
  Turned old(60), out(60);
  const TurnLimits limits = turn_limits(120);
  aim_link({0, -1, 0}, from.fixed(), old_to.fixed(), from.fixed(), to.fixed(), old.fixed(), limits,
           out.track());
  double worst = 0;
  for (std::size_t t = 1; t < 60; ++t)
    worst = std::max(worst, turn(smallest_turn({0, -1, 0}, over[t - 1]), smallest_turn({0, -1, 0}, over[t])));
  EXPECT_GT(worst * degrees_per_radian, 60) << "else there is nothing to hold";
  for (std::size_t t = 1; t < 60; ++t) {
    const Quat step = inverse(out.fixed()[t - 1]) * out.fixed()[t];
    EXPECT_LE(std::fabs(HalfTwist(step, {0, -1, 0}).angle()), limits.twist_departure + 1e-9) << t;
  }
}

}  // namespace
}  // namespace kinegraph
