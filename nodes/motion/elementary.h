// Elementary functions compiled into the project: the C library picks variants by CPU whose last bits differ, and every
// result here must be the same everywhere. Within 1 ulp or two of the true value over the ranges stated.
// Every algorithm uses these and never std::sin and the like; std::sqrt, floor, abs, fma-free + - * / are exact anyway.
#pragma once

namespace kinegraph {

struct SinCos {
  double sin, cos;
};
SinCos sin_cos(double radians);  // |x| up to 1e6
double sine(double radians);
double cosine(double radians);
double arc_tangent2(double y, double x);
double arc_cosine(double x);  // clamps to [-1, 1]
double arc_sine(double x);    // clamps to [-1, 1]
double exponential(double x);
double logarithm(double x);   // natural; x > 0, else -inf or NaN
double power(double base, double exponent);  // base > 0
double hyperbolic_tangent(double x);
double log_cosh(double x);    // ln cosh x, without overflow

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double degrees_per_radian = 180.0 / pi;

}  // namespace kinegraph
