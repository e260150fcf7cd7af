#include "nodes/motion/track_kernels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/every_target.h"

namespace kinegraph {
namespace {

constexpr std::size_t frames = 203;  // no multiple of a vector's lanes

// Four series of numbers that look like chance.
class Series {
 public:
  explicit Series(std::uint64_t state) : data_(4 * frames) {
    for (double& x : data_) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      x = static_cast<double>(state >> 11) * 0x1p-52 - 1;
    }
  }
  QuatTrack quats() { return {of(0), of(1), of(2), of(3)}; }
  Vec3Track points() { return {of(0), of(1), of(2)}; }
  ConstQuatTrack seen_quats() { return {of(0), of(1), of(2), of(3)}; }
  ConstVec3Track seen() { return {of(0), of(1), of(2)}; }
  const std::vector<double>& numbers() const { return data_; }

 private:
  std::span<double> of(std::size_t n) { return std::span(data_).subspan(n * frames, frames); }
  std::vector<double> data_;
};

double apart(Quat a, Quat b) {
  return std::fabs(a.x - b.x) + std::fabs(a.y - b.y) + std::fabs(a.z - b.z) + std::fabs(a.w - b.w);
}

TEST(TrackKernels, MultiplyAndNormaliseEveryFrame) {
  Series a(1), b(2), out(3);
  a.quats().set(17, {0, 0, 0, 0});
  for (bool inverse_of_a : {false, true}) {
    on_every_target([&] {
      multiply_tracks(a.seen_quats(), inverse_of_a, b.seen_quats(), out.quats());
      return out.numbers();
    });
    for (std::size_t t = 0; t < frames; ++t) {
      const Quat p = a.quats()[t];
      EXPECT_LT(apart(out.quats()[t], normalized((inverse_of_a ? inverse(p) : p) * b.quats()[t])), 1e-14);
    }
    EXPECT_EQ(out.quats()[17], Quat{});
  }
  // In place.
  multiply_tracks(a.seen_quats(), true, b.seen_quats(), a.quats());
  EXPECT_EQ(a.numbers(), out.numbers());
}

TEST(TrackKernels, TurnDirectionsTheSmallestWay) {
  Series a(4), b(5), c(6), d(7), out(8);
  const auto set = [&](std::size_t t, Vec3 old_link, Vec3 link) {
    b.points().set(t, a.points()[t] + old_link);
    d.points().set(t, c.points()[t] + link);
  };
  set(3, {1, 2, 3}, {-1, -2, -3});
  set(4, {1, 0, 0}, {-1, 1e-9, 0});
  set(5, {0, 0, 0}, {1, 0, 0});
  set(6, {0, 1, 0}, {0, 1, 0});
  set(199, {1e-130, 0, 0}, {0, 1, 0});
  on_every_target([&] {
    smallest_turns(a.seen(), b.seen(), c.seen(), d.seen(), out.quats());
    return out.numbers();
  });
  for (std::size_t t = 0; t < frames; ++t)
    EXPECT_LT(
        apart(out.quats()[t], smallest_turn(b.points()[t] - a.points()[t], d.points()[t] - c.points()[t])),
        1e-12)
        << t;
}

TEST(TrackKernels, ComposeAndHangAsTheOperatorsDoToTheBit) {
  Series a(21), b(22), start(23), product(24), hung(25);
  for (bool inverse_of_a : {false, true}) {
    on_every_target([&] {
      compose_tracks(a.seen_quats(), inverse_of_a, b.seen_quats(), product.quats());
      return product.numbers();
    });
    for (std::size_t t = 0; t < frames; ++t) {
      const Quat p = a.quats()[t];
      EXPECT_EQ(product.quats()[t], (inverse_of_a ? inverse(p) : p) * b.quats()[t]) << t;
    }
  }
  on_every_target([&] {
    hang_tracks(start.seen(), a.seen_quats(), b.seen(), hung.points());
    return hung.numbers();
  });
  for (std::size_t t = 0; t < frames; ++t)
    EXPECT_EQ(hung.points()[t], start.points()[t] + rotate(a.quats()[t], b.points()[t])) << t;
}

TEST(TrackKernels, AimLinksUpToTheFrameThatTakesMoreCare) {
  const Vec3 rest{0.1, -0.4, 0.2};
  Series base(31), from(32), to(33), out(34);
  for (std::size_t t = 0; t < frames; ++t) {
    base.quats().set(t, normalized(base.quats()[t]));
    // Within 90° of where the base points.
    const Vec3 now = rotate(base.quats()[t], rest);
    to.points().set(t, from.points()[t] + now + 0.9 * norm(rest) * normalized(to.points()[t]));
  }
  const auto aim = [&](std::size_t begin) {
    return aim_tracks(base.seen_quats(), rest, norm(rest), from.seen(), to.seen(), out.quats(), begin);
  };
  on_every_target([&] {
    EXPECT_EQ(aim(0), frames);
    return out.numbers();
  });
  for (std::size_t t = 0; t < frames; ++t) {
    const Quat q = base.quats()[t];
    const Quat wanted = smallest_turn(rotate(q, rest), to.points()[t] - from.points()[t]) * q;
    EXPECT_LT(turn(out.quats()[t], wanted), 1e-7) << t;
    EXPECT_NEAR(dot(out.quats()[t], out.quats()[t]), 1, 1e-14) << t;
  }
  from.points().set(50, to.points()[50]);                                      // no direction
  to.points().set(101, from.points()[101] - rotate(base.quats()[101], rest));  // the opposite one
  on_every_target([&] {
    EXPECT_EQ(aim(0), 50u);
    EXPECT_EQ(aim(51), 101u);
    EXPECT_EQ(aim(102), frames);
    return out.numbers();
  });
}

TEST(TrackKernels, FindTheNextStepOfARotation) {
  Series track(9);
  for (std::size_t t = 0; t < frames; ++t)
    track.quats().set(t,
                      axis_angle({0, 1, 0}, (t >= 57 ? 0.8 : 0) + (t >= 58 ? 0.8 : 0) + (t >= 201 ? 9 : 0)));
  std::vector<double> found = on_every_target([&] {
    std::vector<double> all;
    for (std::size_t t = next_step_below(track.seen_quats(), std::cos(0.3), 1); t < frames;
         t = next_step_below(track.seen_quats(), std::cos(0.3), t + 1))
      all.push_back(static_cast<double>(t));
    return all;
  });
  EXPECT_EQ(found, (std::vector<double>{57, 58, 201}));
  EXPECT_EQ(next_step_below(track.seen_quats(), 0.1, frames), frames);
}

TEST(TrackKernels, FindTheNextTurnOfALink) {
  Series from(10), to(11);
  for (std::size_t t = 0; t < frames; ++t) {
    const double angle = (t >= 30 ? 0.7 : 0) + (t >= 90 ? 3 : 0) + (t >= 202 ? 0.7 : 0);
    const double length = t >= 89 && t <= 90 ? 0.01 : 1;
    to.points().set(t, from.points()[t] + length * Vec3{std::cos(angle), std::sin(angle), 0});
  }
  const double square = std::cos(0.6) * std::cos(0.6);
  const auto all = [&](double shortest) {
    return on_every_target([&] {
      std::vector<double> found;
      for (std::size_t t = next_turn_beyond(from.seen(), to.seen(), square, shortest, 1); t < frames;
           t = next_turn_beyond(from.seen(), to.seen(), square, shortest, t + 1))
        found.push_back(static_cast<double>(t));
      return found;
    });
  };
  EXPECT_EQ(all(0.04), (std::vector<double>{30, 202}));
  EXPECT_EQ(all(1e-6), (std::vector<double>{30, 90, 202}));
}

}  // namespace
}  // namespace kinegraph
