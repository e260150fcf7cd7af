#include "nodes/cartoon/mass_spring_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/cartoon/mass_spring_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinegraph::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, spring_room>;

double Couplings(const SpringRows& rows, const SpringStep& step) {
  const D d;
  const auto one = hn::Set(d, 1.0), zero = hn::Zero(d), link = hn::Set(d, step.link);
  const auto h = hn::Set(d, step.h), half_square = hn::Set(d, 0.5 * step.h * step.h);
  const auto own = hn::Set(d, step.own), least = hn::Set(d, step.least);
  auto weakest = zero;
  for (std::size_t i = rows.first; i < rows.end; i += hn::Lanes(d)) {
    const auto sum = hn::Add(hn::LoadU(d, rows.next_r + i), hn::LoadU(d, rows.r + i));
    const auto ratio = hn::Div(hn::LoadU(d, rows.lengths + i), sum);
    auto c = hn::IfThenElseZero(hn::Gt(sum, zero), hn::Mul(link, hn::Sub(one, ratio)));
    weakest = hn::Min(weakest, c);
    c = hn::Max(c, least);
    const auto coupling = hn::Mul(half_square, c), pull = hn::Mul(h, c);
    hn::StoreU(coupling, d, rows.coupling + i);
    hn::StoreU(pull, d, rows.pull + i);
    hn::StoreU(hn::Add(own, coupling), d, rows.diagonal + i);
    for (int axis = 0; axis < 3; ++axis)
      hn::StoreU(
          hn::Add(hn::LoadU(d, rows.free[axis] + i), hn::Mul(pull, hn::LoadU(d, rows.to_parent[axis] + i))),
          d, rows.right[axis] + i);
  }
  return hn::GetLane(hn::MinOfLanes(d, weakest));
}

double Misses(const SpringRows& rows, const SpringStep& step) {
  const D d;
  const auto h = hn::Set(d, step.h), exact = hn::Set(d, step.exact), zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
  const auto answer = hn::Set(d, 0.5 * step.link * step.h * step.h / step.own);
  auto most = zero;
  for (std::size_t i = rows.first; i < rows.end; i += hn::Lanes(d)) {
    auto square = zero;
    for (int axis = 0; axis < 3; ++axis) {
      const auto away =
          hn::Sub(hn::Mul(h, hn::LoadU(d, rows.velocity[axis] + i)), hn::LoadU(d, rows.to_parent[axis] + i));
      square = hn::Add(square, hn::Mul(away, away));
    }
    const auto guess = hn::LoadU(d, rows.next_r + i);
    const auto sum = hn::Add(guess, hn::LoadU(d, rows.r + i));
    const auto reached = hn::Sqrt(square), missed = hn::Sub(reached, guess);
    most = hn::Max(most, hn::Sub(hn::Abs(missed), hn::Mul(exact, sum)));
    const auto give =
        hn::IfThenElseZero(hn::Gt(sum, zero), hn::Mul(answer, hn::Div(hn::LoadU(d, rows.lengths + i), sum)));
    const auto share = hn::Div(one, hn::Add(one, hn::Mul(two, give)));
    hn::StoreU(reached, d, rows.reached + i);
    const auto shared = hn::Mul(missed, share);
    hn::StoreU(share, d, rows.share + i);
    hn::StoreU(shared, d, rows.missed + i);
    hn::StoreU(hn::Mul(give, shared), d, rows.push + i);
  }
  return hn::GetLane(hn::MaxOfLanes(d, most));
}

}  // namespace kinegraph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinegraph {

HWY_EXPORT(Couplings);
HWY_EXPORT(Misses);

double spring_couplings(const SpringRows& rows, const SpringStep& step) {
  return HWY_DYNAMIC_DISPATCH(Couplings)(rows, step);
}

double spring_misses(const SpringRows& rows, const SpringStep& step) {
  return HWY_DYNAMIC_DISPATCH(Misses)(rows, step);
}

}  // namespace kinegraph
#endif
