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
template <class D>
HWY_INLINE Three<D> Load(D d, const ConstVec3Track& v, std::size_t t) {
  return {hn::LoadU(d, v.x.data() + t), hn::LoadU(d, v.y.data() + t), hn::LoadU(d, v.z.data() + t)};
}
template <class D>
HWY_INLINE void Store(D d, const Three<D>& v, const Vec3Track& out, std::size_t t) {
  hn::StoreU(v.x, d, out.x.data() + t);
  hn::StoreU(v.y, d, out.y.data() + t);
  hn::StoreU(v.z, d, out.z.data() + t);
}
template <class D>
HWY_INLINE void Store(D d, const Four<D>& q, const QuatTrack& out, std::size_t t) {
  hn::StoreU(q.x, d, out.x.data() + t);
  hn::StoreU(q.y, d, out.y.data() + t);
  hn::StoreU(q.z, d, out.z.data() + t);
  hn::StoreU(q.w, d, out.w.data() + t);
}
template <class D>
HWY_INLINE Four<D> Inverse(const Four<D>& q) {
  return {hn::Neg(q.x), hn::Neg(q.y), hn::Neg(q.z), q.w};
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
  if (inverse) p = Inverse<D>(p);
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

template <class D>
HWY_INLINE Three<D> Cross(D, const Three<D>& a, const Three<D>& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

// (a × b, |a||b| + a·b). Where the two are nearly opposite or nothing, the product has lost its digits: true.
template <class D>
HWY_INLINE bool SmallestAt(D d, const ConstVec3Track& old_from, const ConstVec3Track& old_to,
                           const ConstVec3Track& from, const ConstVec3Track& to, const QuatTrack& out,
                           std::size_t t) {
  const Three<D> a = Between(d, old_from, old_to, t), b = Between(d, from, to, t);
  const auto size = hn::Mul(hn::Sqrt(Dot(d, a, a)), hn::Sqrt(Dot(d, b, b)));
  const auto w = hn::Add(size, Dot(d, a, b));
  const Three<D> axis = Cross(d, a, b);
  StoreUnit(d, Four<D>{axis.x, axis.y, axis.z, w}, out, t);
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

// The operators of rotation.h, their operations in the same order.
template <class D>
HWY_INLINE Four<D> Product(D, const Four<D>& a, const Four<D>& b) {
  const auto sum = [](auto first, auto second, auto third, auto minus) {
    return hn::Sub(hn::Add(hn::Add(first, second), third), minus);
  };
  return {
      sum(hn::Mul(a.w, b.x), hn::Mul(a.x, b.w), hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
      hn::Add(hn::Add(hn::Sub(hn::Mul(a.w, b.y), hn::Mul(a.x, b.z)), hn::Mul(a.y, b.w)), hn::Mul(a.z, b.x)),
      hn::Add(hn::Sub(hn::Add(hn::Mul(a.w, b.z), hn::Mul(a.x, b.y)), hn::Mul(a.y, b.x)), hn::Mul(a.z, b.w)),
      hn::Sub(hn::Sub(hn::Sub(hn::Mul(a.w, b.w), hn::Mul(a.x, b.x)), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z))};
}
template <class D>
HWY_INLINE Three<D> Rotate(D d, const Four<D>& q, const Three<D>& v) {
  const Three<D> u{q.x, q.y, q.z}, c = Cross(d, u, v);
  const auto two = hn::Set(d, 2.0);
  const Three<D> t{hn::Mul(two, c.x), hn::Mul(two, c.y), hn::Mul(two, c.z)}, second = Cross(d, u, t);
  return {hn::Add(hn::Add(v.x, hn::Mul(q.w, t.x)), second.x),
          hn::Add(hn::Add(v.y, hn::Mul(q.w, t.y)), second.y),
          hn::Add(hn::Add(v.z, hn::Mul(q.w, t.z)), second.z)};
}

template <class D>
HWY_INLINE void ComposeAt(D d, const ConstQuatTrack& a, bool inverse, const ConstQuatTrack& b,
                          const QuatTrack& out, std::size_t t) {
  const Four<D> p = Load(d, a, t);
  Store(d, Product(d, inverse ? Inverse<D>(p) : p, Load(d, b, t)), out, t);
}

void ComposeTracks(const ConstQuatTrack& a, bool inverse, const ConstQuatTrack& b, const QuatTrack& out) {
  const hn::CappedTag<double, 8> d;
  const hn::CappedTag<double, 1> single;
  const std::size_t n = hn::Lanes(d), frames = out.w.size();
  std::size_t t = 0;
  for (; t + n <= frames; t += n) ComposeAt(d, a, inverse, b, out, t);
  for (; t < frames; ++t) ComposeAt(single, a, inverse, b, out, t);
}

template <class D>
HWY_INLINE void HangAt(D d, const ConstVec3Track& start, const ConstQuatTrack& turn,
                       const ConstVec3Track& link, const Vec3Track& out, std::size_t t) {
  const Three<D> from = Load(d, start, t), turned = Rotate(d, Load(d, turn, t), Load(d, link, t));
  Store(d, Three<D>{hn::Add(from.x, turned.x), hn::Add(from.y, turned.y), hn::Add(from.z, turned.z)}, out, t);
}

void HangTracks(const ConstVec3Track& start, const ConstQuatTrack& turn, const ConstVec3Track& link,
                const Vec3Track& out) {
  const hn::CappedTag<double, 8> d;
  const hn::CappedTag<double, 1> single;
  const std::size_t n = hn::Lanes(d), frames = out.x.size();
  std::size_t t = 0;
  for (; t + n <= frames; t += n) HangAt(d, start, turn, link, out, t);
  for (; t < frames; ++t) HangAt(single, start, turn, link, out, t);
}

// False where it isn't done: one of these frames takes more care.
template <class D>
HWY_INLINE bool AimAt(D d, const ConstQuatTrack& base, Vec3 rest, double rest_length,
                      const ConstVec3Track& from, const ConstVec3Track& to, const QuatTrack& out,
                      std::size_t t) {
  const Three<D> link = Between(d, from, to, t);
  const auto length = hn::Sqrt(Dot(d, link, link));
  const Four<D> before = Load(d, base, t);
  const Three<D> along{hn::Set(d, rest.x), hn::Set(d, rest.y), hn::Set(d, rest.z)};
  const Three<D> now = Rotate(d, before, along);
  const auto lengths = hn::Mul(hn::Set(d, rest_length), length), half = hn::Add(lengths, Dot(d, now, link));
  const auto is_plain =
      hn::And(hn::Ge(length, hn::Set(d, 1e-9)), hn::Gt(half, hn::Mul(hn::Set(d, 0.125), lengths)));
  if (!hn::AllTrue(d, is_plain)) return false;
  const Three<D> axis = Cross(d, now, link);
  const Four<D> turned = Product(d, Four<D>{axis.x, axis.y, axis.z, half}, before);
  const auto size = hn::Sqrt(hn::Add(
      hn::Add(hn::Add(hn::Mul(turned.x, turned.x), hn::Mul(turned.y, turned.y)), hn::Mul(turned.z, turned.z)),
      hn::Mul(turned.w, turned.w)));
  Store(d,
        Four<D>{hn::Div(turned.x, size), hn::Div(turned.y, size), hn::Div(turned.z, size),
                hn::Div(turned.w, size)},
        out, t);
  return true;
}

std::size_t AimTracks(const ConstQuatTrack& base, Vec3 rest, double rest_length, const ConstVec3Track& from,
                      const ConstVec3Track& to, const QuatTrack& out, std::size_t start) {
  const hn::CappedTag<double, 8> d;
  const hn::CappedTag<double, 1> single;
  const std::size_t n = hn::Lanes(d), frames = out.w.size();
  std::size_t t = start;
  while (t + n <= frames && AimAt(d, base, rest, rest_length, from, to, out, t)) t += n;
  while (t < frames && AimAt(single, base, rest, rest_length, from, to, out, t)) ++t;
  return t;
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
HWY_EXPORT(ComposeTracks);
HWY_EXPORT(HangTracks);
HWY_EXPORT(AimTracks);
HWY_EXPORT(NextStepBelow);
HWY_EXPORT(NextTurnBeyond);

void multiply_tracks(ConstQuatTrack a, bool inverse_of_a, ConstQuatTrack b, QuatTrack out) {
  HWY_DYNAMIC_DISPATCH(MultiplyTracks)(a, inverse_of_a, b, out);
}

void smallest_turns(ConstVec3Track old_from, ConstVec3Track old_to, ConstVec3Track from, ConstVec3Track to,
                    QuatTrack out) {
  HWY_DYNAMIC_DISPATCH(SmallestTurns)(old_from, old_to, from, to, out);
}

void compose_tracks(ConstQuatTrack a, bool inverse_of_a, ConstQuatTrack b, QuatTrack out) {
  HWY_DYNAMIC_DISPATCH(ComposeTracks)(a, inverse_of_a, b, out);
}

void hang_tracks(ConstVec3Track start, ConstQuatTrack turn, ConstVec3Track link, Vec3Track out) {
  HWY_DYNAMIC_DISPATCH(HangTracks)(start, turn, link, out);
}

std::size_t aim_tracks(ConstQuatTrack base, Vec3 rest, double rest_length, ConstVec3Track from,
                       ConstVec3Track to, QuatTrack out, std::size_t start) {
  return HWY_DYNAMIC_DISPATCH(AimTracks)(base, rest, rest_length, from, to, out, start);
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
