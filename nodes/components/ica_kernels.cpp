#include "nodes/components/ica_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/components/ica_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinegraph::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Eight lanes in all, as 8 / Lanes vectors: the arithmetic of each lane is the same for every vector width.
using D = hn::CappedTag<double, 8>;
constexpr std::size_t kLanes = 8;

// ((0+4)+(2+6)) + ((1+5)+(3+7)): the one order in which eight running sums are added.
double sum_of_lanes(const double* s) {
  return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

// A block of kA x kB products of rows over `columns` (a multiple of 8) frames; adds eight running sums to
// each.
template <std::size_t kA, std::size_t kB>
void block_of_products(const double* const* a, const double* const* b, std::size_t columns, double* sums) {
  const D d;
  const std::size_t n = hn::Lanes(d);
  for (std::size_t lane = 0; lane < kLanes; lane += n) {
    hn::Vec<D> s[kA][kB];
    for (std::size_t i = 0; i < kA; ++i)
      for (std::size_t j = 0; j < kB; ++j) s[i][j] = hn::LoadU(d, sums + (i * kB + j) * kLanes + lane);
    for (std::size_t t = lane; t < columns; t += kLanes) {
      hn::Vec<D> y[kB];
      for (std::size_t j = 0; j < kB; ++j) y[j] = hn::LoadU(d, b[j] + t);
      for (std::size_t i = 0; i < kA; ++i) {
        const auto x = hn::LoadU(d, a[i] + t);
        for (std::size_t j = 0; j < kB; ++j) s[i][j] = hn::Add(s[i][j], hn::Mul(x, y[j]));
      }
    }
    for (std::size_t i = 0; i < kA; ++i)
      for (std::size_t j = 0; j < kB; ++j) hn::StoreU(s[i][j], d, sums + (i * kB + j) * kLanes + lane);
  }
}

template <std::size_t kA, std::size_t kB>
void whole_block(const double* a, const double* b, std::size_t i0, std::size_t j0, std::size_t columns,
                 std::size_t n, double* out) {
  // Frames in slices that stay in the first cache; the sums are carried on, so slices don't change the bits.
  constexpr std::size_t kSlice = 512;
  const double *pa[kA], *pb[kB];
  double sums[kA * kB * kLanes] = {};
  const std::size_t whole = columns / kLanes * kLanes;
  for (std::size_t t = 0; t < whole; t += kSlice) {
    for (std::size_t i = 0; i < kA; ++i) pa[i] = a + (i0 + i) * columns + t;
    for (std::size_t j = 0; j < kB; ++j) pb[j] = b + (j0 + j) * columns + t;
    block_of_products<kA, kB>(pa, pb, whole - t < kSlice ? whole - t : kSlice, sums);
  }
  for (std::size_t i = 0; i < kA; ++i)
    for (std::size_t j = 0; j < kB; ++j) {
      double* s = sums + (i * kB + j) * kLanes;
      for (std::size_t t = whole; t < columns; ++t)
        s[t - whole] += a[(i0 + i) * columns + t] * b[(j0 + j) * columns + t];
      out[(i0 + i) * n + j0 + j] = sum_of_lanes(s);
    }
}

void ProductsOfRows(const double* a, std::size_t m, const double* b, std::size_t n, std::size_t columns,
                    bool symmetric, double* out) {
  constexpr std::size_t kBlock = 3;
  for (std::size_t i = 0; i < m; i += kBlock) {
    for (std::size_t j = 0; j < n; j += kBlock) {
      if (symmetric && j > i + kBlock - 1) break;
      if (i + kBlock <= m && j + kBlock <= n) {
        whole_block<kBlock, kBlock>(a, b, i, j, columns, n, out);
      } else {
        for (std::size_t p = i; p < m && p < i + kBlock; ++p)
          for (std::size_t q = j; q < n && q < j + kBlock; ++q)
            whole_block<1, 1>(a, b, p, q, columns, n, out);
      }
    }
  }
  if (symmetric)
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = i + 1; j < n; ++j) out[i * n + j] = out[j * n + i];
}

void MixRows(const double* w, std::size_t m, std::size_t k, const double* z, std::size_t columns, double* y) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  constexpr std::size_t kSlice = 256;
  for (std::size_t start = 0; start < columns; start += kSlice) {
    const std::size_t end = start + kSlice < columns ? start + kSlice : columns;
    for (std::size_t i = 0; i < m; ++i) {
      std::size_t t = start;
      for (; t + lanes <= end; t += lanes) {
        auto sum = hn::Mul(hn::Set(d, w[i * k]), hn::LoadU(d, z + t));
        for (std::size_t j = 1; j < k; ++j)
          sum = hn::Add(sum, hn::Mul(hn::Set(d, w[i * k + j]), hn::LoadU(d, z + j * columns + t)));
        hn::StoreU(sum, d, y + i * columns + t);
      }
      for (; t < end; ++t) {
        double sum = w[i * k] * z[t];
        for (std::size_t j = 1; j < k; ++j) sum = sum + w[i * k + j] * z[j * columns + t];
        y[i * columns + t] = sum;
      }
    }
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
  constexpr double kInverseFactorial[] = {1.0 / 6227020800.0,
                                          1.0 / 479001600.0,
                                          1.0 / 39916800.0,
                                          1.0 / 3628800.0,
                                          1.0 / 362880.0,
                                          1.0 / 40320.0,
                                          1.0 / 5040.0,
                                          1.0 / 720.0,
                                          1.0 / 120.0,
                                          1.0 / 24.0,
                                          1.0 / 6.0,
                                          0.5,
                                          1.0,
                                          1.0};
  auto p = hn::Set(d, kInverseFactorial[0]);
  for (int i = 1; i < 14; ++i) p = hn::Add(hn::Mul(p, r), hn::Set(d, kInverseFactorial[i]));
  const auto scale = hn::ShiftLeft<52>(hn::Add(hn::BitCast(du, shifted), hn::Set(du, 1023)));
  return hn::Mul(p, hn::BitCast(d, scale));
}

// One vector of y: g(y), its slope g'(y).
template <class V>
void Nonlinear(D d, int kind, V y, V& g, V& slope) {
  const auto one = hn::Set(d, 1.0);
  if (kind == 0) {
    const auto x = hn::Min(hn::Abs(y), hn::Set(d, 20.0));
    const auto e = Exponential(d, hn::Add(x, x));
    g = hn::CopySign(hn::Sub(one, hn::Div(hn::Set(d, 2.0), hn::Add(e, one))), y);
    slope = hn::Sub(one, hn::Mul(g, g));
  } else if (kind == 1) {
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

void NonlinearityOfRow(int kind, double* y, std::size_t columns, double* slope, double* beta) {
  const D d;
  const std::size_t n = hn::Lanes(d);
  HWY_ALIGN double slopes[kLanes] = {}, betas[kLanes] = {};
  const std::size_t whole = columns / kLanes * kLanes;
  for (std::size_t lane = 0; lane < kLanes; lane += n) {
    auto slope_sum = hn::Zero(d), beta_sum = hn::Zero(d);
    for (std::size_t t = lane; t < whole; t += kLanes) {
      const auto x = hn::LoadU(d, y + t);
      hn::Vec<D> g, s;
      Nonlinear(d, kind, x, g, s);
      slope_sum = hn::Add(slope_sum, s);
      beta_sum = hn::Add(beta_sum, hn::Mul(x, g));
      hn::StoreU(g, d, y + t);
    }
    hn::StoreU(slope_sum, d, slopes + lane);
    hn::StoreU(beta_sum, d, betas + lane);
  }
  if (whole < columns) {  // the rest as one padded group of eight
    HWY_ALIGN double x[kLanes] = {}, g[kLanes], s[kLanes];
    for (std::size_t t = whole; t < columns; ++t) x[t - whole] = y[t];
    for (std::size_t lane = 0; lane < kLanes; lane += n) {
      hn::Vec<D> gv, sv;
      Nonlinear(d, kind, hn::LoadU(d, x + lane), gv, sv);
      hn::StoreU(gv, d, g + lane);
      hn::StoreU(sv, d, s + lane);
    }
    for (std::size_t t = whole; t < columns; ++t) {
      slopes[t - whole] += s[t - whole];
      betas[t - whole] += x[t - whole] * g[t - whole];
      y[t] = g[t - whole];
    }
  }
  *slope = sum_of_lanes(slopes);
  *beta = sum_of_lanes(betas);
}

// ln cosh y = |y| + ln(1 + e) - ln 2 with e = exp(-2|y|); ln(1 + e) = 2 artanh(s), s = e / (2 + e) <= 1/3, by
// its series to s^33 (error under 1e-17).
template <class V>
V LogCosh(D d, V y) {
  const auto x = hn::Abs(y);
  const auto e = Exponential(d, hn::Mul(hn::Set(d, -2.0), hn::Min(x, hn::Set(d, 300.0))));
  const auto s = hn::Div(e, hn::Add(hn::Set(d, 2.0), e));
  const auto square = hn::Mul(s, s);
  auto p = hn::Set(d, 1.0 / 33);
  for (int i = 31; i >= 1; i -= 2) p = hn::Add(hn::Mul(p, square), hn::Set(d, 1.0 / i));
  return hn::Add(hn::Sub(x, hn::Set(d, 0.69314718055994530942)), hn::Mul(hn::Add(s, s), p));
}

double SumOfLogCosh(const double* y, std::size_t columns) {
  const D d;
  const std::size_t n = hn::Lanes(d);
  HWY_ALIGN double sums[kLanes] = {};
  const std::size_t whole = columns / kLanes * kLanes;
  for (std::size_t lane = 0; lane < kLanes; lane += n) {
    auto sum = hn::Zero(d);
    for (std::size_t t = lane; t < whole; t += kLanes) sum = hn::Add(sum, LogCosh(d, hn::LoadU(d, y + t)));
    hn::StoreU(sum, d, sums + lane);
  }
  if (whole < columns) {
    HWY_ALIGN double x[kLanes] = {}, g[kLanes];
    for (std::size_t t = whole; t < columns; ++t) x[t - whole] = y[t];
    for (std::size_t lane = 0; lane < kLanes; lane += n)
      hn::StoreU(LogCosh(d, hn::LoadU(d, x + lane)), d, g + lane);
    for (std::size_t t = whole; t < columns; ++t) sums[t - whole] += g[t - whole];
  }
  return sum_of_lanes(sums);
}

}  // namespace kinegraph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinegraph {

HWY_EXPORT(ProductsOfRows);
HWY_EXPORT(MixRows);
HWY_EXPORT(NonlinearityOfRow);
HWY_EXPORT(SumOfLogCosh);

void products_of_rows(const double* a, std::size_t m, const double* b, std::size_t n, std::size_t columns,
                      bool symmetric, double* out) {
  HWY_DYNAMIC_DISPATCH(ProductsOfRows)(a, m, b, n, columns, symmetric, out);
}
void mix_rows(const double* w, std::size_t m, std::size_t k, const double* z, std::size_t columns,
              double* y) {
  HWY_DYNAMIC_DISPATCH(MixRows)(w, m, k, z, columns, y);
}
void nonlinearity_of_row(int kind, double* y, std::size_t columns, double* slope, double* beta) {
  HWY_DYNAMIC_DISPATCH(NonlinearityOfRow)(kind, y, columns, slope, beta);
}

double sum_of_log_cosh(const double* y, std::size_t columns) {
  return HWY_DYNAMIC_DISPATCH(SumOfLogCosh)(y, columns);
}

}  // namespace kinegraph
#endif
