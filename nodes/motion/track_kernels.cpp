#include "nodes/motion/track_kernels.h"

#include <cmath>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/motion/track_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinegraph::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Compiled for one lane too, which does what is left of a track after whole vectors: the same arithmetic.
template <class D>
struct Three {
  hn::Vec<D> x, y, z;
};
template <class D>
struct Four {
  hn::Vec<D> x, y, z, w;
};

template <class D>
HWY_INLINE Four<D> Load(D d, const ConstQuatTrack& q, std::size_t t) {
  return {hn::LoadU(d, q.x.data() + t), hn::LoadU(d, q.y.data() + t), hn::LoadU(d, q.z.data() + t),
          hn::LoadU(d, q.w.data() + t)};
}
// b − a.
template <class D>
HWY_INLINE Three<D> Between(D d, const ConstVec3Track& a, const ConstVec3Track& b, std::size_t t) {
  return {hn::Sub(hn::LoadU(d, b.x.data() + t), hn::LoadU(d, a.x.data() + t)),
          hn::Sub(hn::LoadU(d, b.y.data() + t), hn::LoadU(d, a.y.data() + t)),
          hn::Sub(hn::LoadU(d, b.z.data() + t), hn::LoadU(d, a.z.data() + t))};
}
template <class D>
HWY_INLINE hn::Vec<D> Dot(D, const Three<D>& a, const Three<D>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <class D>
HWY_INLINE hn::Vec<D> Dot(D, const Four<D>& a, const Four<D>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)),
                 hn::Add(hn::Mul(a.z, b.z), hn::Mul(a.w, b.w)));
}
// At unit length; identity where it is zero.
template <class D>
HWY_INLINE void StoreUnit(D d, const Four<D>& q, const QuatTrack& out, std::size_t t) {
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const auto n = hn::Sqrt(Dot(d, q, q));
  const auto is = hn::Gt(n, zero);
  const auto inverse = hn::IfThenElseZero(is, hn::Div(one, n));
  hn::StoreU(hn::Mul(q.x, inverse), d, out.x.data() + t);
  hn::StoreU(hn::Mul(q.y, inverse), d, out.y.data() + t);
  hn::StoreU(hn::Mul(q.z, inverse), d, out.z.data() + t);
  hn::StoreU(hn::IfThenElse(is, hn::Mul(q.w, inverse), one), d, out.w.data() + t);
}

template <class D>
HWY_INLINE void MultiplyAt(D d, const ConstQuatTrack& a, bool inverse, const ConstQuatTrack& b,
                           const QuatTrack& out, std::size_t t) {
  Four<D> p = Load(d, a, t);
  const Four<D> q = Load(d, b, t);
  if (inverse) p = {hn::Neg(p.x), hn::Neg(p.y), hn::Neg(p.z), p.w};
  const Four<D> product{
      hn::Add(hn::Add(hn::Mul(p.w, q.x), hn::Mul(p.x, q.w)), hn::Sub(hn::Mul(p.y, q.z), hn::Mul(p.z, q.y))),
      hn::Add(hn::Add(hn::Mul(p.w, q.y), hn::Mul(p.y, q.w)), hn::Sub(hn::Mul(p.z, q.x), hn::Mul(p.x, q.z))),
      hn::Add(hn::Add(hn::Mul(p.w, q.z), hn::Mul(p.z, q.w)), hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x))),
      hn::Sub(hn::Sub(hn::Mul(p.w, q.w), hn::Mul(p.x, q.x)), hn::Add(hn::Mul(p.y, q.y), hn::Mul(p.z, q.z)))};
  StoreUnit(d, product, out, t);
}

void MultiplyTracks(const ConstQuatTrack& a, bool inverse, const ConstQuatTrack& b, const QuatTrack& out) {
  const hn::CappedTag<double, 8> d;
  const hn::CappedTag<double, 1> single;
  const std::size_t n = hn::Lanes(d), frames = out.w.size();
  std::size_t t = 0;
  for (; t + n <= frames; t += n) MultiplyAt(d, a, inverse, b, out, t);
  for (; t < frames; ++t) MultiplyAt(single, a, inverse, b, out, t);
}

// (a × b, |a||b| + a·b). Where the two are nearly opposite or nothing, the product has lost its digits: true.
template <class D>
HWY_INLINE bool SmallestAt(D d, const ConstVec3Track& old_from, const ConstVec3Track& old_to,
                           const ConstVec3Track& from, const ConstVec3Track& to, const QuatTrack& out,
                           std::size_t t) {
  const Three<D> a = Between(d, old_from, old_to, t), b = Between(d, from, to, t);
  const auto size = hn::Mul(hn::Sqrt(Dot(d, a, a)), hn::Sqrt(Dot(d, b, b)));
  const auto w = hn::Add(size, Dot(d, a, b));
  const Four<D> turned{hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
                       hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
                       hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x)), w};
  StoreUnit(d, turned, out, t);
  const auto tiny = hn::Lt(size, hn::Set(d, 1e-100)), huge = hn::Gt(size, hn::Set(d, 1e100));
  const auto opposite = hn::Lt(w, hn::Mul(hn::Set(d, 0.125), size));
  return !hn::AllFalse(d, hn::Or(opposite, hn::Or(tiny, huge)));
}

void SmallestTurns(const ConstVec3Track& old_from, const ConstVec3Track& old_to, const ConstVec3Track& from,
                   const ConstVec3Track& to, const QuatTrack& out) {
  const hn::CappedTag<double, 8> d;
  const hn::CappedTag<double, 1> single;
  const std::size_t n = hn::Lanes(d), frames = out.w.size();
  std::size_t t = 0;
  while (t < frames) {
    if (t + n <= frames && !SmallestAt(d, old_from, old_to, from, to, out, t)) {
      t += n;
      continue;
    }
    for (const std::size_t end = t + n < frames ? t + n : frames; t < end; ++t)
      if (SmallestAt(single, old_from, old_to, from, to, out, t))
        out.set(t, smallest_turn(old_to[t] - old_from[t], to[t] - from[t]));
  }
}

template <class D>
HWY_INLINE bool IsStepBelow(D d, const ConstQuatTrack& track, double least, std::size_t t) {
  const auto along = hn::Abs(Dot(d, Load(d, track, t - 1), Load(d, track, t)));
  return !hn::AllTrue(d, hn::Ge(along, hn::Set(d, least)));
}

std::size_t NextStepBelow(const ConstQuatTrack& track, double least, std::size_t start) {
  const hn::CappedTag<double, 8> d;
  const hn::CappedTag<double, 1> single;
  const std::size_t n = hn::Lanes(d), frames = track.w.size();
  std::size_t t = start;
  while (t + n <= frames && !IsStepBelow(d, track, least, t)) t += n;
  while (t < frames && !IsStepBelow(single, track, least, t)) ++t;
  return t;
}

template <class D>
HWY_INLINE bool IsTurnBeyond(D d, const ConstVec3Track& from, const ConstVec3Track& to, double cosine_squared,
                             double shortest_squared, std::size_t t) {
  const Three<D> before = Between(d, from, to, t - 1), link = Between(d, from, to, t);
  const auto squared_before = Dot(d, before, before), squared = Dot(d, link, link);
  const auto along = Dot(d, before, link), shortest = hn::Set(d, shortest_squared);
  const auto within = hn::Ge(hn::Mul(along, hn::Abs(along)),
                             hn::Mul(hn::Set(d, cosine_squared), hn::Mul(squared, squared_before)));
  const auto is_short = hn::Or(hn::Le(squared, shortest), hn::Le(squared_before, shortest));
  return !hn::AllTrue(d, hn::Or(within, is_short));
}

std::size_t NextTurnBeyond(const ConstVec3Track& from, const ConstVec3Track& to, double cosine_squared,
                           double shortest_squared, std::size_t start) {
  const hn::CappedTag<double, 8> d;
  const hn::CappedTag<double, 1> single;
  const std::size_t n = hn::Lanes(d), frames = from.x.size();
  std::size_t t = start;
  while (t + n <= frames && !IsTurnBeyond(d, from, to, cosine_squared, shortest_squared, t)) t += n;
  while (t < frames && !IsTurnBeyond(single, from, to, cosine_squared, shortest_squared, t)) ++t;
  return t;
}

}  // namespace kinegraph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinegraph {

HWY_EXPORT(MultiplyTracks);
HWY_EXPORT(SmallestTurns);
HWY_EXPORT(NextStepBelow);
HWY_EXPORT(NextTurnBeyond);

void multiply_tracks(ConstQuatTrack a, bool inverse_of_a, ConstQuatTrack b, QuatTrack out) {
  HWY_DYNAMIC_DISPATCH(MultiplyTracks)(a, inverse_of_a, b, out);
}

void smallest_turns(ConstVec3Track old_from, ConstVec3Track old_to, ConstVec3Track from, ConstVec3Track to,
                    QuatTrack out) {
  HWY_DYNAMIC_DISPATCH(SmallestTurns)(old_from, old_to, from, to, out);
}

std::size_t next_step_below(ConstQuatTrack track, double least, std::size_t start) {
  return HWY_DYNAMIC_DISPATCH(NextStepBelow)(track, least, start);
}

std::size_t next_turn_beyond(ConstVec3Track from, ConstVec3Track to, double cosine_squared,
                             double shortest_squared, std::size_t start) {
  return HWY_DYNAMIC_DISPATCH(NextTurnBeyond)(from, to, cosine_squared, shortest_squared, start);
}

}  // namespace kinegraph
#endif
