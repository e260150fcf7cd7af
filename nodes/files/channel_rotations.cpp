#include "nodes/files/channel_rotations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/files/channel_rotations.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinegraph {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using U = hn::RebindToUnsigned<D>;

struct HalfAngle {
  V sin, cos;
};

// sin and cos of half of `degrees`. The half-angle is brought into ±45° by multiples of 90, exactly; then the
// kernels of fdlibm (Sun Microsystems 1993), within 1 ulp there.
HWY_INLINE HalfAngle half_angle(D d, V degrees) {
  const U u;
  const V half = hn::Mul(degrees, hn::Set(d, 0.5));
  // Adding 1.5 * 2^52 rounds to an integer, whose last bits are then the quadrant.
  const V magic = hn::Set(d, 6755399441055744.0);
  const V shifted = hn::Add(hn::Mul(half, hn::Set(d, 1.0 / 90.0)), magic);
  const V turns = hn::Sub(shifted, magic);
  const V rest = hn::Sub(half, hn::Mul(turns, hn::Set(d, 90.0)));
  const V x = hn::Mul(rest, hn::Set(d, 0.017453292519943295));
  const V z = hn::Mul(x, x);
  auto step = [&](V sum, double coefficient) { return hn::Add(hn::Mul(sum, z), hn::Set(d, coefficient)); };
  V s = hn::Set(d, 1.58969099521155010221e-10);
  s = step(s, -2.50507602534068634195e-08);
  s = step(s, 2.75573137070700676789e-06);
  s = step(s, -1.98412698298579493134e-04);
  s = step(s, 8.33333333332248946124e-03);
  s = step(s, -1.66666666666666324348e-01);
  const V sine = hn::Add(x, hn::Mul(hn::Mul(x, z), s));
  V c = hn::Set(d, -1.13596475577881948265e-11);
  c = step(c, 2.08757232129817482790e-09);
  c = step(c, -2.75573143513906633035e-07);
  c = step(c, 2.48015872894767294178e-05);
  c = step(c, -1.38888888888741095749e-03);
  c = step(c, 4.16666666666666019037e-02);
  const V one = hn::Set(d, 1.0);
  const V half_z = hn::Mul(z, hn::Set(d, 0.5));
  const V w = hn::Sub(one, half_z);
  const V cosine = hn::Add(w, hn::Add(hn::Sub(hn::Sub(one, w), half_z), hn::Mul(hn::Mul(z, z), c)));
  const auto bits = hn::BitCast(u, shifted);
  const auto one_bit = hn::Set(u, 1);
  const auto odd = hn::RebindMask(d, hn::Ne(hn::And(bits, one_bit), hn::Zero(u)));
  // Quadrants 2 and 3 negate the sine, 1 and 2 the cosine: bit 1 of n, and of n + 1.
  const V sine_sign = hn::BitCast(d, hn::ShiftLeft<62>(hn::And(bits, hn::Set(u, 2))));
  const V cosine_sign = hn::BitCast(d, hn::ShiftLeft<62>(hn::And(hn::Add(bits, one_bit), hn::Set(u, 2))));
  return {hn::Xor(hn::IfThenElse(odd, cosine, sine), sine_sign),
          hn::Xor(hn::IfThenElse(odd, sine, cosine), cosine_sign)};
}

// `count` is a multiple of the lanes.
HWY_INLINE void rotate_frames(const int* axes, std::size_t axis_count, const double* const* degrees,
                              double* x, double* y, double* z, double* w, std::size_t count) {
  const D d;
  for (std::size_t t = 0; t < count; t += hn::Lanes(d)) {
    // v[axis] and the two that follow it cyclically: multiplying by a turn about one axis is the same for all
    // three.
    V v[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    V real = hn::Set(d, 1.0);
    for (std::size_t i = 0; i < axis_count; ++i) {
      const HalfAngle h = half_angle(d, hn::LoadU(d, degrees[i] + t));
      const int a = axes[i], b = (a + 1) % 3, c = (a + 2) % 3;
      if (i == 0) {
        v[a] = h.sin;
        real = h.cos;
        continue;
      }
      const V va = v[a], vb = v[b], vc = v[c], vw = real;
      v[a] = hn::Add(hn::Mul(va, h.cos), hn::Mul(vw, h.sin));
      v[b] = hn::Add(hn::Mul(vb, h.cos), hn::Mul(vc, h.sin));
      v[c] = hn::Sub(hn::Mul(vc, h.cos), hn::Mul(vb, h.sin));
      real = hn::Sub(hn::Mul(vw, h.cos), hn::Mul(va, h.sin));
    }
    hn::StoreU(v[0], d, x + t);
    hn::StoreU(v[1], d, y + t);
    hn::StoreU(v[2], d, z + t);
    hn::StoreU(real, d, w + t);
  }
}

void Rotations(const int* axes, std::size_t axis_count, const double* const* degrees, double* x, double* y,
               double* z, double* w, std::size_t count) {
  const std::size_t lanes = hn::Lanes(D());
  const std::size_t whole = count / lanes * lanes;
  rotate_frames(axes, axis_count, degrees, x, y, z, w, whole);
  if (whole == count) return;
  // The last frames go through the same code, padded.
  constexpr std::size_t room = HWY_MAX_BYTES / sizeof(double);
  double in[8][room] = {}, out[4][room];
  const double* pointers[8];
  for (std::size_t i = 0; i < axis_count; ++i) {
    for (std::size_t t = whole; t < count; ++t) in[i][t - whole] = degrees[i][t];
    pointers[i] = in[i];
  }
  rotate_frames(axes, axis_count, pointers, out[0], out[1], out[2], out[3], lanes);
  for (std::size_t t = whole; t < count; ++t) {
    x[t] = out[0][t - whole];
    y[t] = out[1][t - whole];
    z[t] = out[2][t - whole];
    w[t] = out[3][t - whole];
  }
}

// Whether some neighbours have a negative dot product.
bool AnyFlip(const double* x, const double* y, const double* z, const double* w, std::size_t count) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t t = 1;
  auto negative = hn::Lt(hn::Zero(d), hn::Zero(d));
  for (; t + lanes <= count; t += lanes) {
    auto product = [&](const double* c) { return hn::Mul(hn::LoadU(d, c + t), hn::LoadU(d, c + t - 1)); };
    const V sum = hn::Add(hn::Add(product(x), product(y)), hn::Add(product(z), product(w)));
    negative = hn::Or(negative, hn::Lt(sum, hn::Zero(d)));
  }
  if (!hn::AllFalse(d, negative)) return true;
  for (; t < count; ++t)
    if (x[t] * x[t - 1] + y[t] * y[t - 1] + (z[t] * z[t - 1] + w[t] * w[t - 1]) < 0) return true;
  return false;
}

void Conjugate(const double* m, double* x, double* y, double* z, std::size_t count) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t t = 0;
  for (; t + lanes <= count; t += lanes) {
    const V a = hn::LoadU(d, x + t), b = hn::LoadU(d, y + t), c = hn::LoadU(d, z + t);
    auto row = [&](const double* r) {
      return hn::Add(hn::Add(hn::Mul(hn::Set(d, r[0]), a), hn::Mul(hn::Set(d, r[1]), b)),
                     hn::Mul(hn::Set(d, r[2]), c));
    };
    hn::StoreU(row(m), d, x + t);
    hn::StoreU(row(m + 3), d, y + t);
    hn::StoreU(row(m + 6), d, z + t);
  }
  for (; t < count; ++t) {
    const double a = x[t], b = y[t], c = z[t];
    x[t] = m[0] * a + m[1] * b + m[2] * c;
    y[t] = m[3] * a + m[4] * b + m[5] * c;
    z[t] = m[6] * a + m[7] * b + m[8] * c;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace kinegraph
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinegraph {

HWY_EXPORT(Rotations);
HWY_EXPORT(AnyFlip);
HWY_EXPORT(Conjugate);

namespace {

constexpr std::size_t most_axes_at_once = 8;

void turn_by(std::string_view axes, std::span<const double* const> degrees, QuatTrack out) {
  int indices[most_axes_at_once];
  for (std::size_t i = 0; i < axes.size(); ++i) indices[i] = axes[i] - 'X';
  HWY_DYNAMIC_DISPATCH(Rotations)
  (indices, axes.size(), degrees.data(), out.x.data(), out.y.data(), out.z.data(), out.w.data(),
   out.x.size());
}

}  // namespace

void rotations_from_degrees(std::string_view axes, std::span<const double* const> degrees, QuatTrack out) {
  turn_by(axes.substr(0, most_axes_at_once), degrees.subspan(0, std::min(degrees.size(), most_axes_at_once)),
          out);
  if (axes.size() <= most_axes_at_once) return;
  std::vector<double> rest(4 * out.x.size());
  std::span<double> all(rest);
  std::size_t n = out.x.size();
  QuatTrack tail{all.subspan(0, n), all.subspan(n, n), all.subspan(2 * n, n), all.subspan(3 * n, n)};
  rotations_from_degrees(axes.substr(most_axes_at_once), degrees.subspan(most_axes_at_once), tail);
  for (std::size_t t = 0; t < n; ++t) out.set(t, out[t] * tail[t]);
}

void conjugate_by(Quat c, QuatTrack q) {
  const Vec3 x = rotate(c, {1, 0, 0}), y = rotate(c, {0, 1, 0}), z = rotate(c, {0, 0, 1});
  const double m[9] = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
  HWY_DYNAMIC_DISPATCH(Conjugate)(m, q.x.data(), q.y.data(), q.z.data(), q.x.size());
}

void make_track_continuous(QuatTrack q) {
  if (!HWY_DYNAMIC_DISPATCH(AnyFlip)(q.x.data(), q.y.data(), q.z.data(), q.w.data(), q.x.size())) return;
  for (std::size_t t = 1; t < q.x.size(); ++t)
    if (dot(q[t], q[t - 1]) < 0) q.set(t, -q[t]);
}

double largest_size(std::span<const double> values) {
  double largest = 0;
  bool unordered = false;
  for (double value : values) {
    double size = std::fabs(value);
    unordered |= !(size >= 0);
    largest = size > largest ? size : largest;
  }
  return unordered ? std::numeric_limits<double>::infinity() : largest;
}

bool same_rotations(std::string_view axes, std::span<const double* const> degrees, ConstQuatTrack q,
                    QuatTrack scratch, std::vector<char>& same) {
  constexpr double tolerance = 1e-11;
  rotations_from_degrees(axes, degrees, scratch);
  same.assign(q.x.size(), 0);
  bool all = true;
  for (std::size_t t = 0; t < same.size(); ++t) {
    const Quat a = nearer(scratch[t], q[t]), b = q[t];
    const double apart = std::max(std::max(std::fabs(a.x - b.x), std::fabs(a.y - b.y)),
                                  std::max(std::fabs(a.z - b.z), std::fabs(a.w - b.w)));
    same[t] = apart <= tolerance;
    all &= apart <= tolerance;
  }
  return all;
}

}  // namespace kinegraph
#endif  // HWY_ONCE
