#include "nodes/components/ica_kernels.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/elementary.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/components/ica_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinegraph::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Eight lanes in all, as 8 / Lanes vectors: the arithmetic of each lane is the same for every vector width.
using D = hn::CappedTag<double, 8>;
constexpr std::size_t kLanes = kernel_lanes;

// ((0+4)+(2+6)) + ((1+5)+(3+7)): the one order in which eight running sums are added.
double sum_of_lanes(const double* s) {
  return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

void AddUpLanes(const double* sums, std::size_t count, double* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = sum_of_lanes(sums + i * kLanes);
}

double SumOfRow(const double* x, std::size_t count, double shift) {
  const D d;
  const std::size_t n = hn::Lanes(d), whole = count / kLanes * kLanes;
  HWY_ALIGN double sums[kLanes] = {};
  for (std::size_t lane = 0; lane < kLanes; lane += n) {
    auto sum = hn::Zero(d);
    for (std::size_t t = lane; t < whole; t += kLanes)
      sum = hn::Add(sum, hn::Sub(hn::LoadU(d, x + t), hn::Set(d, shift)));
    hn::StoreU(sum, d, sums + lane);
  }
  for (std::size_t t = whole; t < count; ++t) sums[t - whole] += x[t] - shift;
  return sum_of_lanes(sums);
}

void SubtractFromRow(const double* x, std::size_t count, double shift, double* out) {
  const D d;
  const std::size_t n = hn::Lanes(d);
  std::size_t t = 0;
  for (; t + n <= count; t += n) hn::StoreU(hn::Sub(hn::LoadU(d, x + t), hn::Set(d, shift)), d, out + t);
  for (; t < count; ++t) out[t] = x[t] - shift;
}

// The compiler would read a vector that is used several times from memory each time, as an operand of the
// multiplication; loads are what these loops have least of.
template <class V>
HWY_INLINE void KeepInRegister(V& v) {
#if HWY_ARCH_X86 && HWY_COMPILER_GCC_ACTUAL
  asm("" : "+x"(v.raw));
#else
  (void)v;
#endif
}

// The frames after the last whole eight, for kA x kB products.
template <std::size_t kA, std::size_t kB>
void AddRest(const double* a, std::size_t a_stride, const double* b, std::size_t b_stride, std::size_t count,
             double* sums, std::size_t row) {
  for (std::size_t i = 0; i < kA; ++i)
    for (std::size_t j = 0; j < kB; ++j)
      for (std::size_t t = count / kLanes * kLanes; t < count; ++t)
        sums[(i * row + j) * kLanes + t % kLanes] += a[i * a_stride + t] * b[j * b_stride + t];
}

// One product of rows into its eight sums.
void AddOne(const double* a, const double* b, std::size_t count, double* sums) {
  const D d;
  const std::size_t width = hn::Lanes(d), whole = count / kLanes * kLanes;
  for (std::size_t lane = 0; lane < kLanes; lane += width) {
    auto s = hn::LoadU(d, sums + lane);
    for (std::size_t t = lane; t < whole; t += kLanes)
      s = hn::Add(s, hn::Mul(hn::LoadU(d, a + t), hn::LoadU(d, b + t)));
    hn::StoreU(s, d, sums + lane);
  }
  AddRest<1, 1>(a, 0, b, 0, count, sums, 1);
}

// 3 x 3 products, the sums of a row of a `row` products apart from those of the next. Every sum has a name:
// arrays of vectors made the compiler load each number three times.
void AddNine(const double* a, std::size_t a_stride, const double* b, std::size_t b_stride, std::size_t count,
             double* sums, std::size_t row) {
  const D d;
  const std::size_t width = hn::Lanes(d), whole = count / kLanes * kLanes;
  const double *a1 = a + a_stride, *a2 = a1 + a_stride, *b1 = b + b_stride, *b2 = b1 + b_stride;
  double *second = sums + row * kLanes, *third = second + row * kLanes;
  for (std::size_t lane = 0; lane < kLanes; lane += width) {
    double *p = sums + lane, *q = second + lane, *r = third + lane;
    auto s00 = hn::LoadU(d, p), s01 = hn::LoadU(d, p + kLanes), s02 = hn::LoadU(d, p + 2 * kLanes);
    auto s10 = hn::LoadU(d, q), s11 = hn::LoadU(d, q + kLanes), s12 = hn::LoadU(d, q + 2 * kLanes);
    auto s20 = hn::LoadU(d, r), s21 = hn::LoadU(d, r + kLanes), s22 = hn::LoadU(d, r + 2 * kLanes);
    for (std::size_t t = lane; t < whole; t += kLanes) {
      auto y0 = hn::LoadU(d, b + t), y1 = hn::LoadU(d, b1 + t), y2 = hn::LoadU(d, b2 + t);
      KeepInRegister(y0);
      KeepInRegister(y1);
      KeepInRegister(y2);
      auto x0 = hn::LoadU(d, a + t);
      KeepInRegister(x0);
      s00 = hn::Add(s00, hn::Mul(x0, y0));
      s01 = hn::Add(s01, hn::Mul(x0, y1));
      s02 = hn::Add(s02, hn::Mul(x0, y2));
      auto x1 = hn::LoadU(d, a1 + t);
      KeepInRegister(x1);
      s10 = hn::Add(s10, hn::Mul(x1, y0));
      s11 = hn::Add(s11, hn::Mul(x1, y1));
      s12 = hn::Add(s12, hn::Mul(x1, y2));
      auto x2 = hn::LoadU(d, a2 + t);
      KeepInRegister(x2);
      s20 = hn::Add(s20, hn::Mul(x2, y0));
      s21 = hn::Add(s21, hn::Mul(x2, y1));
      s22 = hn::Add(s22, hn::Mul(x2, y2));
    }
    hn::StoreU(s00, d, p);
    hn::StoreU(s01, d, p + kLanes);
    hn::StoreU(s02, d, p + 2 * kLanes);
    hn::StoreU(s10, d, q);
    hn::StoreU(s11, d, q + kLanes);
    hn::StoreU(s12, d, q + 2 * kLanes);
    hn::StoreU(s20, d, r);
    hn::StoreU(s21, d, r + kLanes);
    hn::StoreU(s22, d, r + 2 * kLanes);
  }
  AddRest<3, 3>(a, a_stride, b, b_stride, count, sums, row);
}

void AddProducts(const double* a, std::size_t a_stride, std::size_t m, const double* b, std::size_t b_stride,
                 std::size_t n, std::size_t count, bool symmetric, double* sums) {
  // Rows of b that stay in the first cache while all of a go by.
  constexpr std::size_t kPanel = 9;
  for (std::size_t j0 = 0; j0 < n; j0 += kPanel) {
    for (std::size_t i = symmetric ? j0 / 3 * 3 : 0; i < m; i += 3) {
      for (std::size_t j = j0; j < std::min(n, j0 + kPanel) && (!symmetric || j <= i); j += 3) {
        const double *x = a + i * a_stride, *y = b + j * b_stride;
        double* block = sums + (i * n + j) * kLanes;
        if (i + 3 <= m && j + 3 <= n) {
          AddNine(x, a_stride, y, b_stride, count, block, n);
          continue;
        }
        for (std::size_t p = 0; p < 3 && i + p < m; ++p)
          for (std::size_t q = 0; q < 3 && j + q < n; ++q)
            AddOne(x + p * a_stride, y + q * b_stride, count, block + (p * n + q) * kLanes);
      }
    }
  }
}

// kA rows of y, kV vectors at a time.
template <std::size_t kA, std::size_t kV>
std::size_t MixBlock(const double* w, std::size_t k, const double* z, std::size_t z_stride, std::size_t t,
                     std::size_t count, double* y, std::size_t y_stride) {
  const D d;
  const std::size_t n = hn::Lanes(d);
  for (; t + kV * n <= count; t += kV * n) {
    hn::Vec<D> s[kA][kV];
    for (std::size_t i = 0; i < kA; ++i)
      for (std::size_t v = 0; v < kV; ++v)
        s[i][v] = hn::Mul(hn::Set(d, w[i * k]), hn::LoadU(d, z + t + v * n));
    for (std::size_t j = 1; j < k; ++j) {
      hn::Vec<D> x[kV];
      for (std::size_t v = 0; v < kV; ++v) x[v] = hn::LoadU(d, z + j * z_stride + t + v * n);
      for (std::size_t i = 0; i < kA; ++i) {
        const auto factor = hn::Set(d, w[i * k + j]);
        for (std::size_t v = 0; v < kV; ++v) s[i][v] = hn::Add(s[i][v], hn::Mul(factor, x[v]));
      }
    }
    for (std::size_t i = 0; i < kA; ++i)
      for (std::size_t v = 0; v < kV; ++v) hn::StoreU(s[i][v], d, y + i * y_stride + t + v * n);
  }
  return t;
}
template <std::size_t kA>
void MixBand(const double* w, std::size_t k, const double* z, std::size_t z_stride, std::size_t count,
             double* y, std::size_t y_stride) {
  std::size_t t = MixBlock<kA, 2>(w, k, z, z_stride, 0, count, y, y_stride);
  t = MixBlock<kA, 1>(w, k, z, z_stride, t, count, y, y_stride);
  for (std::size_t i = 0; i < kA; ++i)
    for (std::size_t rest = t; rest < count; ++rest) {
      double sum = w[i * k] * z[rest];
      for (std::size_t j = 1; j < k; ++j) sum = sum + w[i * k + j] * z[j * z_stride + rest];
      y[i * y_stride + rest] = sum;
    }
}

void MixRows(const double* w, std::size_t m, std::size_t k, const double* z, std::size_t z_stride,
             std::size_t count, double* y, std::size_t y_stride) {
  constexpr std::size_t kA = 4, kSlice = 256;
  for (std::size_t start = 0; start < count; start += kSlice) {
    const std::size_t columns = std::min(kSlice, count - start);
    std::size_t i = 0;
    for (; i + kA <= m; i += kA)
      MixBand<kA>(w + i * k, k, z + start, z_stride, columns, y + i * y_stride + start, y_stride);
    for (; i < m; ++i)
      MixBand<1>(w + i * k, k, z + start, z_stride, columns, y + i * y_stride + start, y_stride);
  }
}

// e^x for |x| <= 700: x = n ln 2 + r, |r| <= ln2 / 2, Taylor to r^13 (error under 1e-17), then 2^n by the
// exponent's bits.
template <class V>
V Exponential(D d, V x) {
  const hn::RebindToUnsigned<D> du;
  const auto magic = hn::Set(d, 6755399441055744.0);  // 1.5 * 2^52: adding it leaves round(x) in the low bits
  const auto shifted = hn::Add(hn::Mul(x, hn::Set(d, 1.4426950408889634074)), magic);
  const auto n = hn::Sub(shifted, magic);
  auto r = hn::Sub(x, hn::Mul(n, hn::Set(d, 6.93147180369123816490e-01)));  // ln 2, upper 33 bits
  r = hn::Sub(r, hn::Mul(n, hn::Set(d, 1.90821492927058770002e-10)));       // and the rest
  // Even and odd powers apart, so that a step needn't wait for the one before.
  const auto square = hn::Mul(r, r);
  const auto step = [&](V sum, double next)
                        HWY_ATTR { return hn::Add(hn::Mul(sum, square), hn::Set(d, next)); };
  auto odd = hn::Set(d, 1.0 / 6227020800.0);
  auto even = hn::Set(d, 1.0 / 479001600.0);
  odd = step(odd, 1.0 / 39916800.0);
  even = step(even, 1.0 / 3628800.0);
  odd = step(odd, 1.0 / 362880.0);
  even = step(even, 1.0 / 40320.0);
  odd = step(odd, 1.0 / 5040.0);
  even = step(even, 1.0 / 720.0);
  odd = step(odd, 1.0 / 120.0);
  even = step(even, 1.0 / 24.0);
  odd = step(odd, 1.0 / 6.0);
  even = step(even, 0.5);
  odd = step(odd, 1.0);
  even = step(even, 1.0);
  const auto p = hn::Add(even, hn::Mul(r, odd));
  const auto scale = hn::ShiftLeft<52>(hn::Add(hn::BitCast(du, shifted), hn::Set(du, 1023)));
  return hn::Mul(p, hn::BitCast(d, scale));
}

// One vector of y: g(y), its slope g'(y).
template <int kKind, class V>
void Nonlinear(D d, V y, V& g, V& slope) {
  const auto one = hn::Set(d, 1.0);
  if constexpr (kKind == 0) {
    const auto x = hn::Min(hn::Abs(y), hn::Set(d, 20.0));
    const auto e = Exponential(d, hn::Add(x, x));
    g = hn::CopySign(hn::Sub(one, hn::Div(hn::Set(d, 2.0), hn::Add(e, one))), y);
    slope = hn::Sub(one, hn::Mul(g, g));
  } else if constexpr (kKind == 1) {
    const auto square = hn::Mul(y, y);
    g = hn::Mul(square, y);
    slope = hn::Mul(hn::Set(d, 3.0), square);
  } else {
    const auto square = hn::Min(hn::Mul(y, y), hn::Set(d, 1400.0));
    const auto e = Exponential(d, hn::Mul(hn::Set(d, -0.5), square));
    g = hn::Mul(y, e);
    slope = hn::Mul(hn::Sub(one, square), e);
  }
}

// g(y) over y, g'(y) into eight sums.
template <int kKind>
void NonlinearRow(double* y, std::size_t count, double* slopes) {
  const D d;
  const std::size_t n = hn::Lanes(d), whole = count / kLanes * kLanes;
  for (std::size_t lane = 0; lane < kLanes; lane += n) {
    auto sum = hn::LoadU(d, slopes + lane);
    for (std::size_t t = lane; t < whole; t += kLanes) {
      hn::Vec<D> g, slope;
      Nonlinear<kKind>(d, hn::LoadU(d, y + t), g, slope);
      sum = hn::Add(sum, slope);
      hn::StoreU(g, d, y + t);
    }
    hn::StoreU(sum, d, slopes + lane);
  }
  if (whole == count) return;
  HWY_ALIGN double g[kLanes] = {}, slope[kLanes];  // the rest as one padded group of eight
  for (std::size_t t = whole; t < count; ++t) g[t - whole] = y[t];
  for (std::size_t lane = 0; lane < kLanes; lane += n) {
    hn::Vec<D> gv, sv;
    Nonlinear<kKind>(d, hn::LoadU(d, g + lane), gv, sv);
    hn::StoreU(gv, d, g + lane);
    hn::StoreU(sv, d, slope + lane);
  }
  for (std::size_t t = whole; t < count; ++t) {
    slopes[t - whole] += slope[t - whole];
    y[t] = g[t - whole];
  }
}

void AddMoments(int kind, const double* w, std::size_t m, const double* z, std::size_t stride, std::size_t k,
                std::size_t count, double* scratch, double* zg, double* slope) {
  double* x = scratch + m * moment_slice;  // the slice of z, where no load crosses a cache line
  for (std::size_t start = 0; start < count; start += moment_slice) {
    const std::size_t columns = std::min(moment_slice, count - start);
    for (std::size_t j = 0; j < k; ++j) std::copy_n(z + j * stride + start, columns, x + j * moment_slice);
    MixRows(w, m, k, x, moment_slice, columns, scratch, moment_slice);
    for (std::size_t i = 0; i < m; ++i) {
      double* y = scratch + i * moment_slice;
      if (kind == 0)
        NonlinearRow<0>(y, columns, slope + i * kLanes);
      else if (kind == 1)
        NonlinearRow<1>(y, columns, slope + i * kLanes);
      else
        NonlinearRow<2>(y, columns, slope + i * kLanes);
    }
    AddProducts(scratch, moment_slice, m, x, moment_slice, k, columns, false, zg);
  }
}

// ln cosh y = |y| - ln 2 + ln(1 + e^(-2|y|)): |y| into eight sums, 1 + e^(-2|y|) into the product of all. No
// more than 960 of them, each at most 2, so that the product stays below 2^960.
double LogCoshParts(const double* y, std::size_t count, double* sums) {
  const D d;
  const std::size_t n = hn::Lanes(d), whole = count / kLanes * kLanes;
  HWY_ALIGN double products[kLanes], rest[kLanes];
  std::fill_n(rest, kLanes, 400.0);  // where 1 + e^(-2|y|) is 1
  for (std::size_t t = whole; t < count; ++t) {
    rest[t - whole] = y[t];
    sums[t - whole] += std::fabs(y[t]);
  }
  const auto factor = [&](hn::Vec<D> x) HWY_ATTR {
    const auto limited = hn::Min(x, hn::Set(d, 300.0));
    return hn::Add(hn::Set(d, 1.0), Exponential(d, hn::Mul(hn::Set(d, -2.0), limited)));
  };
  for (std::size_t lane = 0; lane < kLanes; lane += n) {
    auto sum = hn::LoadU(d, sums + lane), product = factor(hn::Abs(hn::LoadU(d, rest + lane)));
    for (std::size_t t = lane; t < whole; t += kLanes) {
      const auto x = hn::Abs(hn::LoadU(d, y + t));
      sum = hn::Add(sum, x);
      product = hn::Mul(product, factor(x));
    }
    hn::StoreU(sum, d, sums + lane);
    hn::StoreU(product, d, products + lane);
  }
  const double* p = products;
  return ((p[0] * p[4]) * (p[2] * p[6])) * ((p[1] * p[5]) * (p[3] * p[7]));
}

void TurnedRoots(const double* a, const double* b, std::size_t count, double c, double s, double* sums) {
  const D d;
  const std::size_t n = hn::Lanes(d), whole = count / kLanes * kLanes;
  const auto vc = hn::Set(d, c), vs = hn::Set(d, s), one = hn::Set(d, 1.0);
  HWY_ALIGN double first[kLanes], second[kLanes];
  for (std::size_t lane = 0; lane < kLanes; lane += n) {
    auto sum_x = hn::Zero(d), sum_y = hn::Zero(d);
    for (std::size_t t = lane; t < whole; t += kLanes) {
      const auto at = hn::LoadU(d, a + t), bt = hn::LoadU(d, b + t);
      const auto x = hn::Add(hn::Mul(vc, at), hn::Mul(vs, bt)), y = hn::Sub(hn::Mul(vc, bt), hn::Mul(vs, at));
      sum_x = hn::Add(sum_x, hn::Sqrt(hn::Add(one, hn::Mul(x, x))));
      sum_y = hn::Add(sum_y, hn::Sqrt(hn::Add(one, hn::Mul(y, y))));
    }
    hn::StoreU(sum_x, d, first + lane);
    hn::StoreU(sum_y, d, second + lane);
  }
  for (std::size_t t = whole; t < count; ++t) {
    const double x = c * a[t] + s * b[t], y = c * b[t] - s * a[t];
    first[t - whole] += std::sqrt(1 + x * x);
    second[t - whole] += std::sqrt(1 + y * y);
  }
  sums[0] = sum_of_lanes(first);
  sums[1] = sum_of_lanes(second);
}

}  // namespace kinegraph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinegraph {

HWY_EXPORT(SumOfRow);
HWY_EXPORT(SubtractFromRow);
HWY_EXPORT(AddProducts);
HWY_EXPORT(AddUpLanes);
HWY_EXPORT(MixRows);
HWY_EXPORT(AddMoments);
HWY_EXPORT(LogCoshParts);
HWY_EXPORT(TurnedRoots);

double sum_of_row(const double* x, std::size_t count, double shift) {
  return HWY_DYNAMIC_DISPATCH(SumOfRow)(x, count, shift);
}
void subtract_from_row(const double* x, std::size_t count, double shift, double* out) {
  HWY_DYNAMIC_DISPATCH(SubtractFromRow)(x, count, shift, out);
}
void add_products(const double* a, std::size_t a_stride, std::size_t m, const double* b, std::size_t b_stride,
                  std::size_t n, std::size_t count, bool symmetric, double* sums) {
  HWY_DYNAMIC_DISPATCH(AddProducts)(a, a_stride, m, b, b_stride, n, count, symmetric, sums);
}
void add_up_lanes(const double* sums, std::size_t count, double* out) {
  HWY_DYNAMIC_DISPATCH(AddUpLanes)(sums, count, out);
}
void mix_rows(const double* w, std::size_t m, std::size_t k, const double* z, std::size_t z_stride,
              std::size_t count, double* y, std::size_t y_stride) {
  HWY_DYNAMIC_DISPATCH(MixRows)(w, m, k, z, z_stride, count, y, y_stride);
}
void add_moments(int kind, const double* w, std::size_t m, const double* z, std::size_t stride, std::size_t k,
                 std::size_t count, double* scratch, double* zg, double* slope) {
  HWY_DYNAMIC_DISPATCH(AddMoments)(kind, w, m, z, stride, k, count, scratch, zg, slope);
}

double sum_of_log_cosh(const double* y, std::size_t count) {
  constexpr std::size_t slice = 960;
  double sums[kernel_lanes] = {}, logs = 0, size = 0;
  for (std::size_t start = 0; start < count; start += slice)
    logs += logarithm(HWY_DYNAMIC_DISPATCH(LogCoshParts)(y + start, std::min(slice, count - start), sums));
  add_up_lanes(sums, 1, &size);
  return size - static_cast<double>(count) * 0.69314718055994530942 + logs;
}

void turned_roots(const double* a, const double* b, std::size_t count, double c, double s, double* sums) {
  HWY_DYNAMIC_DISPATCH(TurnedRoots)(a, b, count, c, s, sums);
}

}  // namespace kinegraph
#endif
