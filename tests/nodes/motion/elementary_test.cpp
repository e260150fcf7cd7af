#include "nodes/motion/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

// The C library's long double functions (64 bits of mantissa) are the oracle.

namespace kinegraph {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

double ulp(double x) {
  x = std::fabs(x);
  return std::nextafter(x, inf) - x;
}

struct Worst {
  double ulps = 0;
  double at = 0;
};
Worst worst_over(const std::function<double()>& draw, double (*ours)(double),
                 long double (*truth)(long double)) {
  Worst worst;
  for (int i = 0; i < 40000; ++i) {
    double x = draw();
    long double t = truth(x);
    double e =
        static_cast<double>(std::fabs(ours(x) - t) / static_cast<long double>(ulp(static_cast<double>(t))));
    if (!(e <= worst.ulps)) worst = {e, x};
  }
  return worst;
}

class Elementary : public ::testing::Test {
 protected:
  std::mt19937_64 random{7};
  std::function<double()> uniform(double low, double high) {
    return [this, low, high] { return std::uniform_real_distribution<double>(low, high)(random); };
  }
  // Magnitudes spread over powers of two, both signs.
  std::function<double()> spread(double low_exponent, double high_exponent) {
    return [this, low_exponent, high_exponent] {
      double e = std::uniform_real_distribution<double>(low_exponent, high_exponent)(random);
      return std::exp2(e) * (random() & 1 ? 1 : -1);
    };
  }
  void expect_within(double ulps, const std::function<double()>& draw, double (*ours)(double),
                     long double (*truth)(long double)) {
    auto worst = worst_over(draw, ours, truth);
    EXPECT_LE(worst.ulps, ulps) << "at " << worst.at;
  }
};

TEST_F(Elementary, sine_and_cosine_are_within_an_ulp_up_to_a_million_radians) {
  for (auto& draw : {uniform(-4, 4), uniform(-100, 100), uniform(-1e6, 1e6), spread(-60, 19)}) {
    expect_within(1, draw, sine, std::sin);
    expect_within(1, draw, cosine, std::cos);
  }
}

TEST_F(Elementary, sine_keeps_its_relative_accuracy_beside_multiples_of_pi) {
  for (int k = 1; k < 600000; k += 97) {
    double x = static_cast<double>(static_cast<long double>(k) * 3.141592653589793238462643383279502884L / 2);
    long double s = std::sin(static_cast<long double>(x)), c = std::cos(static_cast<long double>(x));
    // Long double itself has but 64 bits of π here, so only its error is allowed besides ours.
    EXPECT_NEAR(sine(x), static_cast<double>(s), std::fabs(static_cast<double>(s)) * 3e-16 + 1e-25) << k;
    EXPECT_NEAR(cosine(x), static_cast<double>(c), std::fabs(static_cast<double>(c)) * 3e-16 + 1e-25) << k;
  }
}

TEST_F(Elementary, sine_and_cosine_together_are_sine_and_cosine) {
  auto draw = uniform(-1000, 1000);
  for (int i = 0; i < 1000; ++i) {
    double x = draw();
    auto both = sin_cos(x);
    EXPECT_EQ(both.sin, sine(x));
    EXPECT_EQ(both.cos, cosine(x));
    EXPECT_NEAR(both.sin * both.sin + both.cos * both.cos, 1, 4e-16);
    EXPECT_EQ(sine(-x), -both.sin);
    EXPECT_EQ(cosine(-x), both.cos);
  }
}

TEST_F(Elementary, sine_of_special_values) {
  EXPECT_EQ(sine(0.0), 0);
  EXPECT_TRUE(std::signbit(sine(-0.0)));
  EXPECT_EQ(cosine(0.0), 1);
  EXPECT_EQ(sine(1e-310), 1e-310);
  for (double x : {inf, -inf, nan_value}) {
    EXPECT_TRUE(std::isnan(sine(x)));
    EXPECT_TRUE(std::isnan(cosine(x)));
  }
  // Beyond its range the error stays below what an ulp of x makes of it.
  for (double x : {3e6, 1e9, -7e11}) EXPECT_NEAR(sine(x), std::sin(x), ulp(x)) << x;
}

TEST_F(Elementary, arc_tangent_is_within_two_ulps_in_every_direction) {
  auto coordinate = spread(-40, 40);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    double y = coordinate(), x = i % 3 ? y * uniform(-4, 4)() : coordinate();
    long double t = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    worst =
        std::max(worst, static_cast<double>(std::fabs(arc_tangent2(y, x) - t) / ulp(static_cast<double>(t))));
  }
  EXPECT_LE(worst, 2);
}

TEST_F(Elementary, arc_tangent_of_special_values_is_the_c_librarys) {
  double values[] = {0.0, -0.0, 1.0, -1.0, 1e-310, -1e-310, 1e308, -1e308, 5e-324, inf, -inf};
  for (double y : values)
    for (double x : values) {
      double truth = std::atan2(y, x);
      EXPECT_NEAR(arc_tangent2(y, x), truth, ulp(truth)) << y << " " << x;
      EXPECT_EQ(std::signbit(arc_tangent2(y, x)), std::signbit(truth)) << y << " " << x;
    }
  EXPECT_TRUE(std::isnan(arc_tangent2(nan_value, 1)));
  EXPECT_TRUE(std::isnan(arc_tangent2(1, nan_value)));
}

TEST_F(Elementary, arc_cosine_and_arc_sine_are_within_an_ulp_and_a_half_and_clamp) {
  for (auto& draw : {uniform(-1, 1), uniform(0.999, 1), uniform(-1, -0.999), spread(-60, 0)}) {
    expect_within(1.5, draw, arc_cosine, std::acos);
    expect_within(1.5, draw, arc_sine, std::asin);
  }
  EXPECT_EQ(arc_cosine(1.0000001), 0);
  EXPECT_EQ(arc_cosine(-1.0000001), pi);
  EXPECT_EQ(arc_sine(2), pi / 2);
  EXPECT_EQ(arc_sine(-2), -pi / 2);
  EXPECT_TRUE(std::signbit(arc_sine(-0.0)));
  EXPECT_TRUE(std::isnan(arc_cosine(nan_value)));
  EXPECT_TRUE(std::isnan(arc_sine(nan_value)));
}

TEST_F(Elementary, exponential_is_within_an_ulp_down_to_subnormal_results) {
  for (auto& draw : {uniform(-1, 1), uniform(-700, 709), spread(-60, 2)})
    expect_within(1, draw, exponential, std::exp);
  auto deep = uniform(-745, -708);
  for (int i = 0; i < 1000; ++i) {
    double x = deep();
    EXPECT_NEAR(exponential(x), static_cast<double>(std::exp(static_cast<long double>(x))), 4.95e-324 * 1.5)
        << x;
  }
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(710), inf);
  EXPECT_EQ(exponential(inf), inf);
  EXPECT_EQ(exponential(-746), 0);
  EXPECT_EQ(exponential(-inf), 0);
  EXPECT_TRUE(std::isnan(exponential(nan_value)));
}

TEST_F(Elementary, logarithm_is_within_an_ulp) {
  for (auto& draw : {uniform(0.5, 2), uniform(0.99, 1.01), uniform(1e-3, 1e6)})
    expect_within(1, draw, logarithm, std::log);
  auto exponents = uniform(-1070, 1023);
  expect_within(
      1, [&] { return std::exp2(exponents()); }, logarithm, std::log);
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(logarithm(0), -inf);
  EXPECT_EQ(logarithm(inf), inf);
  EXPECT_TRUE(std::isnan(logarithm(-1)));
  EXPECT_TRUE(std::isnan(logarithm(nan_value)));
}

TEST_F(Elementary, power_is_within_an_ulp_also_of_large_results) {
  auto bases = spread(-20, 20);
  auto exponents = uniform(-50, 50);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    double b = std::fabs(bases()), e = exponents();
    long double t = std::pow(static_cast<long double>(b), static_cast<long double>(e));
    if (t > 1e308L || t < 1e-300L) continue;
    worst = std::max(worst, static_cast<double>(std::fabs(power(b, e) - t) / ulp(static_cast<double>(t))));
  }
  EXPECT_LE(worst, 1);
  for (int n = -30; n <= 30; ++n) EXPECT_EQ(power(2, n), std::ldexp(1.0, n));
  EXPECT_EQ(power(5, 0), 1);
  EXPECT_EQ(power(0, 2), 0);
  EXPECT_EQ(power(0, -2), inf);
  EXPECT_EQ(power(10, 400), inf);
  EXPECT_EQ(power(10, -400), 0);
  EXPECT_EQ(power(inf, 2), inf);
  EXPECT_EQ(power(inf, -2), 0);
  EXPECT_EQ(power(0.5, inf), 0);
  EXPECT_EQ(power(0.5, -inf), inf);
  EXPECT_TRUE(std::isnan(power(-1, 0.5)));
  EXPECT_TRUE(std::isnan(power(nan_value, 2)));
}

TEST_F(Elementary, hyperbolic_tangent_is_within_two_and_a_half_ulps) {
  for (auto& draw : {uniform(-1, 1), uniform(-25, 25), spread(-60, 5)})
    expect_within(2.5, draw, hyperbolic_tangent, std::tanh);
  EXPECT_EQ(hyperbolic_tangent(inf), 1);
  EXPECT_EQ(hyperbolic_tangent(-1e300), -1);
  EXPECT_TRUE(std::isnan(hyperbolic_tangent(nan_value)));
  EXPECT_TRUE(std::signbit(hyperbolic_tangent(-0.0)));
}

TEST_F(Elementary, log_cosh_neither_cancels_nor_overflows) {
  auto truth = [](long double x) -> long double {
    x = std::fabs(x);
    long double s = std::sinh(x / 2);
    return x < 1 ? std::log1p(2 * s * s) : x + std::log1p(std::exp(-2 * x)) - std::log(2.0L);
  };
  for (auto& draw : {uniform(-3, 3), uniform(-900, 900), spread(-400, 0), spread(-10, 10)}) {
    auto worst = worst_over(draw, log_cosh, truth);
    EXPECT_LE(worst.ulps, 4) << worst.at;
  }
  EXPECT_EQ(log_cosh(0), 0);
  EXPECT_EQ(log_cosh(inf), inf);
  EXPECT_TRUE(std::isnan(log_cosh(nan_value)));
}

}  // namespace
}  // namespace kinegraph
