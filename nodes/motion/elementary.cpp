#include "nodes/motion/elementary.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

// The polynomials interpolate at Chebyshev nodes; scripts/derive_elementary.py makes every constant below.

namespace kinegraph {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// c[0] + c[1] x + …, highest power first.
template <int N>
inline double polynomial(const double (&c)[N], double x) {
  double sum = c[N - 1];
  for (int i = N - 2; i >= 0; --i) sum = sum * x + c[i];
  return sum;
}

// An unevaluated sum; |low| is at most half an ulp of high.
struct Pair {
  double high, low;
};
inline Pair sum_of(double a, double b) {
  double s = a + b;
  double from_b = s - a;
  return {s, (a - (s - from_b)) + (b - from_b)};
}
inline Pair sum_of_larger_first(double a, double b) {
  double s = a + b;
  return {s, b - (s - a)};
}
// Exact product by halves of 26 and 27 bits (Dekker); finite while the factors stay under 2^995.
inline Pair halves(double a) {
  double scaled = a * 0x1.0000002p27;  // 2^27 + 1
  double high = scaled - (scaled - a);
  return {high, a - high};
}
inline Pair product(double a, double b) {
  double p = a * b;
  Pair x = halves(a), y = halves(b);
  return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

constexpr double to_nearest = 0x1.8p52;  // adding and subtracting it rounds to a whole number

constexpr double pi_2_high =
    0x1.921fb54400000p+0;  // two parts of 32 bits, so that multiples up to 2^21 are exact
constexpr double pi_2_middle = 0x1.0b4611a600000p-34;
constexpr double pi_2_low = 0x1.3198a2e037073p-69;
constexpr double pi_2 = 0x1.921fb54442d18p+0;
constexpr double pi_2_rest = 0x1.1a62633145c07p-54;
constexpr double ln2_high = 0x1.62e42fee00000p-1;
constexpr double ln2_low = 0x1.a39ef35793c76p-33;
constexpr double ln2_middle = 0x1.a39ef35600000p-33;  // with ln2_rest the same to 117 bits
constexpr double ln2_rest = 0x1.93c7673007e5fp-65;

constexpr double sine_terms[] = {-0x1.5555555555555p-3, 0x1.1111111111110p-7,   -0x1.a01a01a019937p-13,
                                 0x1.71de3a54607a5p-19, -0x1.ae64541295cdfp-26, 0x1.61217ee5cca1bp-33,
                                 -0x1.ab17bdcbd3414p-41};
constexpr double cosine_terms[] = {0x1.5555555555555p-5,   -0x1.6c16c16c16967p-10, 0x1.a01a019f4e9b4p-16,
                                   -0x1.27e4fa17bf139p-22, 0x1.1eeb68cd22f56p-29,  -0x1.907d8f29fe831p-37};
constexpr double arc_tangent_terms[] = {-0x1.5555555555555p-2, 0x1.99999999998c5p-3,  -0x1.2492492485503p-3,
                                        0x1.c71c71bd2b8bcp-4,  -0x1.745d154c84f7ap-4, 0x1.3b1375ce5bdc6p-4,
                                        -0x1.110c9ce7b0572p-4, 0x1.e170800a46210p-5,  -0x1.ab59b417b2d3fp-5,
                                        0x1.7001816fd063fp-5,  -0x1.0f62bba6a2558p-5, 0x1.e4167464d3de8p-7};
constexpr double arc_sine_terms[] = {0x1.5555555555555p-3,  0x1.3333333333388p-4, 0x1.6db6db6dac1e0p-5,
                                     0x1.f1c71c7a52ba3p-6,  0x1.6e8ba123e494cp-6, 0x1.1c4efce23019fp-6,
                                     0x1.c990ad3d8fdcap-7,  0x1.7b027ee1dd585p-7, 0x1.3b49de7121487p-7,
                                     0x1.31622469ce5adp-7,  0x1.8f193743418ffp-9, 0x1.406192d124629p-6,
                                     -0x1.3b416bb7d9257p-6, 0x1.e529c6fce9bb4p-6};
constexpr double exponential_terms[] = {0x1.0000000000000p-1,  0x1.5555555555557p-3,  0x1.5555555555556p-5,
                                        0x1.11111111100dcp-7,  0x1.6c16c16c162d4p-10, 0x1.a01a01abe7fe1p-13,
                                        0x1.a01a01a6d889cp-16, 0x1.71de0231960ebp-19, 0x1.27e4db646b17ep-22,
                                        0x1.af4de97ca4194p-26, 0x1.1f730349868cep-29};
constexpr double logarithm_terms[] = {0x1.5555555555555p-1, 0x1.9999999999a38p-2, 0x1.2492492476c87p-2,
                                      0x1.c71c720160b47p-3, 0x1.745cf901605f7p-3, 0x1.3b1c360763b8ap-3,
                                      0x1.0fbe83c2cbcf3p-3, 0x1.0c04595972ab8p-3};
constexpr double logarithm_later_terms[] = {0x1.999999999999ap-2, 0x1.2492492492491p-2, 0x1.c71c71c71cfd9p-3,
                                            0x1.745d174513593p-3, 0x1.3b13b1bc75cd4p-3, 0x1.1110dfad0f8eap-3,
                                            0x1.e1f7fa7547177p-4, 0x1.ac4a89c964b82p-4, 0x1.b8d433113b7fap-4};
constexpr Pair two_thirds = {0x1.5555555555555p-1, 0x1.5555555555555p-55};

// x 2^k for results down to the smallest subnormal; k within ±2200.
double scaled_by_power_of_two(double x, int k) {
  auto power_of_two = [](int e) { return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52); };
  if (k > 1023) return x * 0x1p1023 * power_of_two(k - 1023 > 1023 ? 1023 : k - 1023);
  if (k >= -1021) return x * power_of_two(k);
  // One rounding only: the first factor is exact.
  return x * power_of_two(k + 1000 < -1022 ? -1022 : k + 1000) * 0x1p-1000;
}

// high + low = k ln 2 + r, and e^r - 1 without cancellation. |high| under 800.
struct ReducedExponential {
  int k;
  double r, low;     // r + low is the remainder, |r| <= ln 2 / 2
  double minus_one;  // e^(r + low) - 1
};
ReducedExponential reduced_exponential(double x, double extra) {
  double k = x * 0x1.71547652b82fep+0 + to_nearest - to_nearest;
  double high = x - k * ln2_high;
  double low = extra - k * ln2_low;
  Pair r = sum_of(high, low);
  double r2 = r.high * r.high;
  double tail = r.low + r.high * r.low + r2 * polynomial(exponential_terms, r.high);
  return {static_cast<int>(k), r.high, r.low, r.high + tail};
}

// e^(x + extra), |extra| tiny.
double exponential_of_sum(double x, double extra) {
  if (x > 709.8) return infinity;
  if (x < -745.2) return 0;
  auto e = reduced_exponential(x, extra);
  double r2 = e.r * e.r;
  // 1 + (r + (…)): the big parts are added last.
  Pair head = sum_of_larger_first(1.0, e.r);
  double tail = head.low + (e.low + e.r * e.low + r2 * polynomial(exponential_terms, e.r));
  return scaled_by_power_of_two(head.high + tail, e.k);
}

// x > 0 as 2^k m with m within [√½, √2).
struct Scaled {
  int k;
  double m;
};
Scaled scaled(double x) {
  int k = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    k = -54;
  }
  auto bits = std::bit_cast<std::uint64_t>(x);
  k += static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull);
  if (m > 0x1.6a09e667f3bcdp+0) {
    m *= 0.5;
    k += 1;
  }
  return {k, m};
}

// ln x to some 65 bits.
Pair logarithm_pair(double x) {
  auto [k, m] = scaled(x);
  // ln m = 2 s + (2/3) s³ + (2/5) s⁵ + …, s = (m - 1)/(m + 1)
  double f = m - 1;
  Pair g = sum_of(m, 1.0);
  double s = f / g.high;
  Pair sg = product(s, g.high);
  double s_low = ((f - sg.high) - sg.low - s * g.low) / g.high;
  Pair z = product(s, s);
  z.low += 2 * s * s_low;
  Pair c = product(z.high, two_thirds.high);
  c.low += z.high * two_thirds.low + z.low * two_thirds.high +
           z.high * z.high * polynomial(logarithm_later_terms, z.high);
  c = sum_of_larger_first(c.high, c.low);
  Pair cs = product(c.high, s);
  cs.low += c.high * s_low + c.low * s;
  Pair sum = sum_of_larger_first(2 * s, cs.high);
  sum.low += 2 * s_low + cs.low;
  double n = k;
  Pair total = sum_of(n * ln2_high, sum.high);
  Pair middle = sum_of(n * ln2_middle, sum.low + n * ln2_rest);
  Pair both = sum_of(total.high, middle.high);
  return sum_of_larger_first(both.high, both.low + total.low + middle.low);
}

double arc_tangent_polynomial(double t) {
  double z = t * t;
  return t * z * polynomial(arc_tangent_terms, z);
}

// arcsin of |x| <= 1/2, less x itself.
double arc_sine_tail(double x) {
  double z = x * x;
  return x * z * polynomial(arc_sine_terms, z);
}

// ln(1 + u), u >= 0.
double logarithm_of_one_plus(double u) {
  double v = 1 + u;
  double lost = u < 1 ? u - (v - 1) : 1 - (v - u);
  return logarithm(v) + lost / v;
}

// e^x - 1, 0 <= x <= 2.
double exponential_less_one(double x) {
  auto e = reduced_exponential(x, 0);
  double power = scaled_by_power_of_two(1, e.k);
  return power * e.minus_one + (power - 1);
}

}  // namespace

SinCos sin_cos(double x) {
  if (!(std::fabs(x) <= 0x1p21)) {
    if (!std::isfinite(x)) return {nan, nan};
    x = std::fmod(
        x, 4 * pi_2);  // exact; 2π as a double is off by less than half an ulp of x after all its turns
  }
  double k = x * 0x1.45f306dc9c883p-1 + to_nearest - to_nearest;
  double exact = x - k * pi_2_high;
  Pair near = sum_of(exact, -(k * pi_2_middle));
  Pair r = sum_of_larger_first(near.high, near.low - k * pi_2_low);
  double z = r.high * r.high;
  double half = 0.5 * z;
  double s = r.high + (r.high * z * polynomial(sine_terms, z) + r.low * (1 - half));
  double w = 1 - half;
  double c = w + (((1 - w) - half) + (z * z * polynomial(cosine_terms, z) - r.high * r.low));
  auto quadrant = static_cast<std::int64_t>(k) & 3;
  double sin = quadrant & 1 ? c : s;
  double cos = quadrant & 1 ? s : c;
  if (quadrant & 2) sin = -sin;
  if ((quadrant + 1) & 2) cos = -cos;
  return {x == 0 ? x : sin, cos};
}
double sine(double radians) {
  return sin_cos(radians).sin;
}
double cosine(double radians) {
  return sin_cos(radians).cos;
}

double arc_tangent2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return nan;
  double a = std::fabs(y), b = std::fabs(x);
  if (std::isinf(a) && std::isinf(b)) a = b = 1;
  double large = a > b ? a : b, small = a > b ? b : a;
  if (large > 0x1p1000) {
    large *= 0x1p-600;
    small *= 0x1p-600;
  } else if (large < 0x1p-900) {
    large *= 0x1p600;
    small *= 0x1p600;
  }
  // The angle of (small, large) within [0, π/4]: base + t + tail.
  double base = 0, base_low = 0, t = 0;
  if (small == 0 || std::isinf(large)) {
    t = 0;
  } else if (16 * small <= 7 * large) {
    t = small / large;
  } else {
    base = 0.5 * pi_2;
    base_low = 0.5 * pi_2_rest;
    t = (small - large) / (small + large);
  }
  double tail = arc_tangent_polynomial(t);
  if (a > b) {  // π/2 - angle
    base = pi_2 - base;
    base_low = pi_2_rest - base_low;
    t = -t;
    tail = -tail;
  }
  if (std::signbit(x)) {  // π - angle
    base = 2 * pi_2 - base;
    base_low = 2 * pi_2_rest - base_low;
    t = -t;
    tail = -tail;
  }
  Pair sum = sum_of(base, t);
  double angle = sum.high + (sum.low + (tail + base_low));
  return std::copysign(angle, y);
}

double arc_cosine(double x) {
  if (std::isnan(x)) return nan;
  if (x >= 1) return 0;
  if (x <= -1) return 2 * pi_2;
  double a = std::fabs(x);
  if (a <= 0.5) {
    Pair sum = sum_of_larger_first(pi_2, -x);
    return sum.high + (sum.low + (pi_2_rest - arc_sine_tail(x)));
  }
  // arccos a = 2 arcsin √((1 - a)/2)
  double z = 0.5 * (1 - a);
  double s = std::sqrt(z);
  double tail = arc_sine_tail(s);
  if (x > 0) return 2 * (s + tail);
  Pair sum = sum_of_larger_first(pi_2, -s);
  return 2 * (sum.high + (sum.low + (pi_2_rest - tail)));
}

double arc_sine(double x) {
  if (std::isnan(x)) return nan;
  if (x >= 1) return pi_2;
  if (x <= -1) return -pi_2;
  double a = std::fabs(x);
  if (a <= 0.5) return x + arc_sine_tail(x);
  // arcsin a = π/2 - 2 arcsin √((1 - a)/2)
  double z = 0.5 * (1 - a);
  double s = std::sqrt(z);
  Pair sum = sum_of_larger_first(pi_2, -2 * s);
  double angle = sum.high + (sum.low + (pi_2_rest - 2 * arc_sine_tail(s)));
  return std::copysign(angle, x);
}

double exponential(double x) {
  return std::isnan(x) ? nan : exponential_of_sum(x, 0);
}

double logarithm(double x) {
  if (std::isnan(x) || x < 0) return nan;
  if (x == 0) return -infinity;
  if (std::isinf(x)) return infinity;
  auto [k, m] = scaled(x);
  // ln m = f - (f²/2 - s (f²/2 + z L(z))), s = f/(2 + f), z = s²: f carries the exact leading part.
  double f = m - 1;
  double s = f / (2 + f);
  double z = s * s;
  double half = 0.5 * f * f;
  double tail = s * (half + z * polynomial(logarithm_terms, z));
  if (k == 0) return f - (half - tail);
  double n = k;
  return n * ln2_high - ((half - (tail + n * ln2_low)) - f);
}

double power(double base, double exponent) {
  if (exponent == 0 || base == 1) return 1;
  if (std::isnan(base) || std::isnan(exponent) || base < 0) return nan;
  if (base == 0) return exponent > 0 ? 0 : infinity;
  if (std::isinf(base)) return exponent > 0 ? infinity : 0;
  if (std::isinf(exponent)) return (exponent > 0) == (base > 1) ? infinity : 0;
  Pair l = logarithm_pair(base);
  double rough = l.high * exponent;
  if (rough > 750) return infinity;
  if (rough < -800) return 0;
  if (std::fabs(exponent) > 0x1p990)
    return 1 + rough;  // the base is 1 within an ulp or so; rough is small here
  Pair p = product(l.high, exponent);
  return exponential_of_sum(p.high, p.low + l.low * exponent);
}

double hyperbolic_tangent(double x) {
  if (std::isnan(x)) return nan;
  double a = std::fabs(x);
  double t;
  if (a > 20) {
    t = 1;
  } else if (a > 0.55) {
    t = 1 - 2 / (exponential(2 * a) + 1);
  } else if (a > 0x1p-28) {
    double e = exponential_less_one(2 * a);
    t = e / (e + 2);
  } else {
    t = a;
  }
  return std::copysign(t, x);
}

double log_cosh(double x) {
  double a = std::fabs(x);
  if (std::isnan(a)) return nan;
  if (a < 1) {
    // cosh a - 1 = (e^a - 1)² / (2 e^a)
    double e = exponential_less_one(a);
    return logarithm_of_one_plus(0.5 * e * (e / (1 + e)));
  }
  if (std::isinf(a)) return infinity;
  double rest = a < 20 ? logarithm_of_one_plus(exponential(-2 * a)) : 0;
  Pair sum = sum_of_larger_first(a, -ln2_high);
  return sum.high + (sum.low - ln2_low + rest);
}

}  // namespace kinegraph
