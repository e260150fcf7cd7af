// Elementary functions compiled into the project: the C library picks variants by CPU whose last bits differ,
// and every result here must be the same everywhere. NaN in, NaN out; infinities and signed zeros as in the C
// library. Every algorithm uses these and never std::sin and the like; std::sqrt, floor, abs, fma-free + - *
// / are exact anyway. Largest errors measured against long double: sine, cosine, exponential, logarithm,
// power 1 ulp; arc functions 2 ulp; hyperbolic tangent 2.5 ulp; log_cosh 4 ulp.
#pragma once

namespace kinegraph {

struct SinCos {
  double sin, cos;
};
SinCos sin_cos(double radians);  // beyond |x| = 2^21 the error grows to an ulp of x
double sine(double radians);
double cosine(double radians);
double arc_tangent2(double y, double x);
double arc_cosine(double x);  // clamps to [-1, 1]
double arc_sine(double x);    // clamps to [-1, 1]
double exponential(double x);
double logarithm(double x);                  // natural; x > 0, else -inf or NaN
double power(double base, double exponent);  // base > 0
double hyperbolic_tangent(double x);
double log_cosh(double x);  // ln cosh x, without overflow

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double degrees_per_radian = 180.0 / pi;

}  // namespace kinegraph
