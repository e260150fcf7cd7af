#include "nodes/motion/rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

class Rotation : public ::testing::Test {
 protected:
  std::mt19937_64 random{11};
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  double normal() { return std::normal_distribution<double>()(random); }
  Vec3 direction() { return normalized(Vec3{normal(), normal(), normal()}); }
  Quat any() { return normalized(Quat{normal(), normal(), normal(), normal()}); }
};

double apart(Quat a, Quat b) {  // as stored, signs included
  return std::sqrt(std::pow(a.x - b.x, 2) + std::pow(a.y - b.y, 2) + std::pow(a.z - b.z, 2) +
                   std::pow(a.w - b.w, 2));
}

TEST_F(Rotation, log_and_exp_undo_each_other_from_tiny_angles_to_pi) {
  for (double half : {0.0, 1e-300, 1e-160, 1e-20, 1e-9, 1e-4, 0.3, 1.5707963, 2.0, 3.0, 3.14159, pi - 1e-9}) {
    for (int i = 0; i < 50; ++i) {
      Vec3 h = half * direction();
      Vec3 back = log(exp(h));
      EXPECT_LE(norm(back - h), 1e-14 + 4e-15 * half) << half;
      EXPECT_NEAR(dot(exp(h), exp(h)), 1, 7e-16);
      if (half > 0 && half < 1e-4) {
        EXPECT_LE(norm((back - h) / half), 1e-15) << half;
      }
    }
  }
}

TEST_F(Rotation, log_is_the_half_angle_vector_of_q_as_it_stands) {
  Quat q = axis_angle({0, 0, 1}, 0.5);
  EXPECT_NEAR(log(q).z, 0.25, 1e-16);
  EXPECT_NEAR(norm(log(-q)), pi - 0.25, 1e-15);
  EXPECT_NEAR(norm(log(Quat{0, 0, 0, -1})), pi, 1e-15);
}

TEST_F(Rotation, turn_is_exact_for_tiny_angles_and_the_same_for_both_signs) {
  for (double angle : {0.0, 1e-15, 1e-12, 1e-8, 1e-3, 1.0, 3.0, pi}) {
    for (int i = 0; i < 20; ++i) {
      Quat q = axis_angle(direction(), angle);
      EXPECT_NEAR(turn(q), angle, 1e-15 * angle + 1e-300 + (angle == pi ? 1e-15 : 0));
      EXPECT_EQ(turn(q), turn(-q));
      Quat a = any();
      EXPECT_NEAR(turn(a, a * q), angle, 2e-15);
      EXPECT_NEAR(turn(a, -(a * q)), angle, 2e-15);
    }
  }
}

TEST_F(Rotation, products_act_right_to_left) {
  for (int i = 0; i < 100; ++i) {
    Quat a = any(), b = any();
    Vec3 v{normal(), normal(), normal()};
    EXPECT_LE(norm(rotate(a * b, v) - rotate(a, rotate(b, v))), 1e-14 * (1 + norm(v)));
    EXPECT_NEAR(norm(rotate(a, v)), norm(v), 1e-14 * (1 + norm(v)));
    EXPECT_LE(norm(rotate(inverse(a), rotate(a, v)) - v), 1e-14 * (1 + norm(v)));
  }
  Vec3 turned = rotate(axis_angle({0, 1, 0}, pi / 2), {0, 0, 1});  // z to x about y: right-handed
  EXPECT_NEAR(turned.x, 1, 1e-15);
}

TEST_F(Rotation, slerp_goes_the_short_way_at_constant_speed) {
  for (int i = 0; i < 200; ++i) {
    Quat a = any(), b = any();
    double whole = turn(a, b), t = between(0, 1);
    EXPECT_NEAR(turn(a, slerp(t, a, b)), t * whole, 1e-14);
    EXPECT_NEAR(turn(slerp(t, a, b), b), (1 - t) * whole, 1e-14);
    EXPECT_NEAR(turn(slerp(t, a, b), slerp(t, a, -b)), 0, 1e-14);
  }
}

TEST_F(Rotation, slerp_is_exactly_its_ends_and_keeps_unit_length) {
  for (int i = 0; i < 200; ++i) {
    Quat a = any(), b = nearer(any(), a);
    EXPECT_EQ(slerp(0, a, b), a);
    EXPECT_EQ(slerp(1, a, b), b);
    for (double t : {-3.0, -0.5, 0.25, 0.999, 1.7, 10.0}) {
      Quat q = slerp(t, a, b);
      EXPECT_NEAR(dot(q, q), 1, 2e-15) << t;
    }
  }
}

TEST_F(Rotation, slerp_extrapolates_along_the_same_turn) {
  for (int i = 0; i < 200; ++i) {
    Vec3 axis = direction();
    double angle = between(0, 1);
    Quat a = any(), b = a * axis_angle(axis, angle);
    for (double t : {-2.0, 1.5, 3.0})
      EXPECT_NEAR(turn(slerp(t, a, b), a * axis_angle(axis, t * angle)), 0, 1e-13) << t << " " << angle;
  }
}

TEST_F(Rotation, slerp_of_nearly_equal_rotations_loses_nothing) {
  for (double angle : {0.0, 1e-16, 1e-12, 1e-8, 3e-8, 1e-6}) {
    Quat a = any(), b = a * axis_angle(direction(), angle);
    EXPECT_NEAR(turn(a, slerp(0.25, a, b)), 0.25 * turn(a, b), 2e-16);
  }
}

TEST_F(Rotation, smallest_turn_takes_one_direction_to_the_other_by_their_angle) {
  for (int i = 0; i < 1000; ++i) {
    Vec3 a = direction(), b = direction();
    if (i % 4 == 1) b = normalized(a + 1e-7 * direction());
    if (i % 4 == 2) b = normalized(-a + std::pow(10, -between(2, 18)) * direction());
    if (i % 4 == 3) b = -a;
    Quat q = smallest_turn(between(1e-200, 1) * a, 1e200 * b);
    EXPECT_LE(norm(rotate(q, a) - b), 2e-15) << i;
    double angle = 2 * std::atan2(norm(b - a), norm(a + b));
    EXPECT_NEAR(turn(q), angle, 3e-15) << i;
  }
  EXPECT_EQ(smallest_turn({0, 0, 0}, {1, 0, 0}), Quat{});
  EXPECT_EQ(smallest_turn({1, 0, 0}, {0, 0, 0}), Quat{});
}

TEST_F(Rotation, twist_leaves_a_swing_that_does_not_turn_about_the_axis) {
  for (int i = 0; i < 200; ++i) {
    Quat q = any();
    Vec3 axis = direction();
    Quat twist = twist_about(q, axis), swing = q * inverse(twist);
    EXPECT_NEAR(dot(Vec3{swing.x, swing.y, swing.z}, axis), 0, 2e-15);
    EXPECT_NEAR(norm(cross({twist.x, twist.y, twist.z}, axis)), 0, 2e-15);
  }
  EXPECT_EQ(twist_about(Quat{1, 0, 0, 0}, {0, 1, 0}), Quat{});  // a swing of 180°
}

TEST_F(Rotation, heading_is_the_twist_about_up) {
  for (double angle : {0.0, 1.0, -3.0, 3.1, pi}) {
    EXPECT_NEAR(heading_of(about_y(angle)), angle, 1e-15);
    EXPECT_NEAR(heading_of(-about_y(angle)), angle, 1e-15);
    EXPECT_NEAR(heading_of(about_y(angle) * axis_angle({1, 0, 0}, 0.7)), angle, 1e-14);
  }
  EXPECT_NEAR(heading_of(about_y(4)), 4 - 2 * pi, 1e-14);
}

TEST_F(Rotation, make_continuous_turns_signs_only_and_leaves_no_jump) {
  std::vector<double> x, y, z, w;
  std::vector<Quat> before;
  for (int t = 0; t < 100; ++t) {
    Quat q = axis_angle({0, 0, 1}, 0.1 * t);
    if (random() & 1) q = -q;
    before.push_back(q);
    x.push_back(q.x), y.push_back(q.y), z.push_back(q.z), w.push_back(q.w);
  }
  make_continuous(x, y, z, w);
  for (int t = 0; t < 100; ++t) {
    Quat q{x[t], y[t], z[t], w[t]};
    EXPECT_TRUE(q == before[t] || q == -before[t]);
    if (t == 0) continue;
    EXPECT_GT(q.x * x[t - 1] + q.y * y[t - 1] + q.z * z[t - 1] + q.w * w[t - 1], 0);
  }
  EXPECT_EQ((Quat{x[0], y[0], z[0], w[0]}), before[0]);
}

// --- Euler angles ---

const char* orders[] = {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"};

Quat product_of_axes(std::string_view axes, const double* radians) {
  Quat q;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    Vec3 axis{axes[i] == 'X' ? 1.0 : 0.0, axes[i] == 'Y' ? 1.0 : 0.0, axes[i] == 'Z' ? 1.0 : 0.0};
    q = q * axis_angle(axis, radians[i]);
  }
  return q;
}

TEST_F(Rotation, from_euler_is_the_product_of_its_axes_in_order) {
  for (const char* axes : {"ZYX", "XYZ", "X", "ZZ", "YXYXZ", ""}) {
    double angles[5];
    for (double& a : angles) a = between(-4, 4);
    EXPECT_LE(apart(from_euler(axes, angles), product_of_axes(axes, angles)), 1e-15) << axes;
  }
}

TEST_F(Rotation, euler_angles_return_as_they_were_with_wraps_and_second_solutions) {
  for (const char* axes : orders) {
    for (int i = 0; i < 500; ++i) {
      double angles[3] = {between(-7, 7), between(-7, 7), between(-7, 7)};
      if (std::fabs(std::cos(angles[1])) < 1e-3) continue;
      auto back = to_euler(from_euler(axes, angles), axes, angles);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], angles[k], 1e-12) << axes << k;
    }
  }
}

TEST_F(Rotation, without_a_wish_euler_angles_are_those_nearest_zero) {
  for (const char* axes : orders) {
    for (int i = 0; i < 200; ++i) {
      double angles[3] = {between(-pi, pi), between(-1.5, 1.5), between(-pi, pi)};
      double other[3] = {angles[0] - std::copysign(pi, angles[0]), std::copysign(pi, angles[1]) - angles[1],
                         angles[2] - std::copysign(pi, angles[2])};
      auto size = [](const double* a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; };
      auto back = to_euler(from_euler(axes, angles), axes, nullptr);
      EXPECT_NEAR(size(back.data()), std::min(size(angles), size(other)), 1e-11) << axes;
    }
  }
}

TEST_F(Rotation, euler_angles_keep_the_rotation_at_and_beside_gimbal_lock) {
  const double billionth_of_a_degree = 1e-9 * pi / 180;
  for (const char* axes : orders) {
    for (double off : {0.0, 1e-16, 1e-14, 1e-13, 1e-12, 3e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
      for (int i = 0; i < 40; ++i) {
        double middle = (i & 1 ? 1 : -1) * pi / 2 + (i & 2 ? off : -off);
        double angles[3] = {between(-4, 4), middle, between(-4, 4)};
        Quat q = from_euler(axes, angles);
        double near[3] = {angles[0] + between(-1, 1), angles[1], angles[2] + between(-1, 1)};
        auto back = to_euler(q, axes, near);
        EXPECT_LE(turn(q, from_euler(axes, back.data())), billionth_of_a_degree) << axes << " " << off;
        EXPECT_NEAR(back[1], middle, 1e-11);
      }
    }
  }
}

TEST_F(Rotation, at_the_singular_middle_angle_the_first_is_the_wished_one) {
  for (const char* axes : orders) {
    for (double middle : {pi / 2, -pi / 2}) {
      double angles[3] = {0.4, middle, -1.1};
      auto same = to_euler(from_euler(axes, angles), axes, angles);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(same[k], angles[k], 1e-12) << axes;
      double near[3] = {2.5, middle, 0};
      EXPECT_EQ(to_euler(from_euler(axes, angles), axes, near)[0], 2.5);
    }
  }
}

}  // namespace
}  // namespace kinegraph
