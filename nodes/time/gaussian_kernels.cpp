#include "nodes/time/gaussian_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/time/gaussian_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinegraph::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;

// Four vectors of neighbours at once, so that no sum waits for itself; each is taken in the same order.
void SymmetricSums(const double* HWY_RESTRICT middle, std::size_t count, const double* HWY_RESTRICT weights,
                   std::size_t radius, double* HWY_RESTRICT out) {
  const D d;
  const std::size_t n = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + 4 * n <= count; i += 4 * n) {
    auto a = hn::Zero(d), b = hn::Zero(d), c = hn::Zero(d), e = hn::Zero(d);
    for (std::size_t k = radius; k > 0; --k) {
      const auto weight = hn::Set(d, weights[k]);
      const double *before = middle + i - k, *after = middle + i + k;
      a = hn::Add(a, hn::Mul(weight, hn::Add(hn::LoadU(d, before), hn::LoadU(d, after))));
      b = hn::Add(b, hn::Mul(weight, hn::Add(hn::LoadU(d, before + n), hn::LoadU(d, after + n))));
      c = hn::Add(c, hn::Mul(weight, hn::Add(hn::LoadU(d, before + 2 * n), hn::LoadU(d, after + 2 * n))));
      e = hn::Add(e, hn::Mul(weight, hn::Add(hn::LoadU(d, before + 3 * n), hn::LoadU(d, after + 3 * n))));
    }
    const auto weight = hn::Set(d, weights[0]);
    hn::StoreU(hn::Add(a, hn::Mul(weight, hn::LoadU(d, middle + i))), d, out + i);
    hn::StoreU(hn::Add(b, hn::Mul(weight, hn::LoadU(d, middle + i + n))), d, out + i + n);
    hn::StoreU(hn::Add(c, hn::Mul(weight, hn::LoadU(d, middle + i + 2 * n))), d, out + i + 2 * n);
    hn::StoreU(hn::Add(e, hn::Mul(weight, hn::LoadU(d, middle + i + 3 * n))), d, out + i + 3 * n);
  }
  for (; i < count; ++i) {
    const double* here = middle + i;
    double sum = 0;
    for (std::size_t k = radius; k > 0; --k) sum += weights[k] * (*(here - k) + here[k]);
    out[i] = sum + weights[0] * *here;
  }
}

}  // namespace kinegraph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinegraph {

HWY_EXPORT(SymmetricSums);

void symmetric_sums(const double* middle, std::size_t count, const double* weights, std::size_t radius,
                    double* out) {
  HWY_DYNAMIC_DISPATCH(SymmetricSums)(middle, count, weights, radius, out);
}

}  // namespace kinegraph
#endif
