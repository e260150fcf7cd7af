#include "nodes/motion/quaternion_mean.h"

#include <array>
#include <cstddef>

#include "nodes/motion/elementary.h"
#include "nodes/motion/half_angle.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;
using Matrix4 = std::array<std::array<double, 4>, 4>;

Quat upper(Quat q) {
  const bool flip = q.w < 0 || (q.w == 0 && (q.x < 0 || (q.x == 0 && (q.y < 0 || (q.y == 0 && q.z < 0)))));
  return flip ? -q : q;
}

// Eigenvector of the largest eigenvalue of a symmetric matrix, by cyclic Jacobi rotations.
std::array<double, 4> leading_eigenvector(Matrix4 a) {
  Matrix4 vectors{};
  for (std::size_t i = 0; i < 4; ++i) vectors[i][i] = 1;
  for (int sweep = 0; sweep < 30; ++sweep) {
    double off = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) off += a[i][j] * a[i][j];
    }
    if (off < 1e-30) break;
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1);
        const double s = t * c;
        for (std::size_t k = 0; k < 4; ++k) {
          const double kp = a[k][p];
          const double kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double pk = a[p][k];
          const double qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double kp = vectors[k][p];
          const double kq = vectors[k][q];
          vectors[k][p] = c * kp - s * kq;
          vectors[k][q] = s * kp + c * kq;
        }
      }
    }
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (a[i][i] > a[best][best]) best = i;
  }
  return {vectors[0][best], vectors[1][best], vectors[2][best], vectors[3][best]};
}

// The top eigenvector of Σ q qᵀ: blind to the signs of the quaternions, and within O(σ³) of the Karcher mean.
Quat chordal_mean(const ConstQuatTrack& rotations) {
  Matrix4 sum{};
  const std::size_t frames = rotations.x.size();
  for (std::size_t t = 0; t < frames; ++t) {
    const std::array<double, 4> q{rotations.x[t], rotations.y[t], rotations.z[t], rotations.w[t]};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) sum[i][j] += q[i] * q[j];
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i; j < 4; ++j) sum[j][i] = sum[i][j] = sum[i][j] / static_cast<double>(frames);
  }
  const auto v = leading_eigenvector(sum);
  return normalized(Quat{v[0], v[1], v[2], v[3]});
}

// What one pass over the frames tells about a candidate mean.
struct Logs {
  Vec3 mean;          // of log(q̄⁻¹ q)
  double square = 0;  // mean of ‖log‖²
  Matrix3 hessian{};  // of square / 2
};

// The Hessian of half the squared distance on the unit sphere: 1 along the log, θ cot θ across it.
Logs logs_around(Quat mean, const ConstQuatTrack& rotations) {
  Logs out;
  const Quat back = inverse(mean);
  const std::size_t frames = rotations.x.size();
  double across = 0;
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (std::size_t t = 0; t < frames; ++t) {
    Quat d = back * rotations[t];
    if (d.w < 0) d = -d;
    const double sine2 = d.x * d.x + d.y * d.y + d.z * d.z;
    const double ratio = angle_over_sine(sine2, d.w);
    const Vec3 v{ratio * d.x, ratio * d.y, ratio * d.z};
    out.mean += v;
    out.square += dot(v, v);
    const double c = ratio * d.w;  // θ cot θ
    across += c;
    const double along = sine2 > 1e-10 ? (1 - c) / sine2 : 1.0 / 3;  // its limit for small angles
    xx += along * d.x * d.x;
    xy += along * d.x * d.y;
    xz += along * d.x * d.z;
    yy += along * d.y * d.y;
    yz += along * d.y * d.z;
    zz += along * d.z * d.z;
  }
  const double n = static_cast<double>(frames);
  out.mean = out.mean / n;
  out.square /= n;
  out.hessian = {{{(across + xx) / n, xy / n, xz / n},
                  {xy / n, (across + yy) / n, yz / n},
                  {xz / n, yz / n, (across + zz) / n}}};
  return out;
}

// H⁻¹ m by Cramer's rule; m itself (a gradient step) where H is nearly singular.
Vec3 newton_step(const Matrix3& h, Vec3 m) {
  const Vec3 a{h[0][0], h[1][0], h[2][0]};
  const Vec3 b{h[0][1], h[1][1], h[2][1]};
  const Vec3 c{h[0][2], h[1][2], h[2][2]};
  const double determinant = dot(a, cross(b, c));
  if (determinant < 1e-3) return m;
  return Vec3{dot(m, cross(b, c)), dot(a, cross(m, c)), dot(a, cross(b, m))} / determinant;
}

}  // namespace

QuaternionMean karcher_mean(const ConstQuatTrack& rotations) {
  QuaternionMean out;
  if (rotations.x.empty()) return out;
  constexpr int most_steps = 200;
  constexpr double settled = 1e-15;

  Quat mean = chordal_mean(rotations);
  Logs logs = logs_around(mean, rotations);
  Vec3 step = newton_step(logs.hessian, logs.mean);
  double residual = norm(logs.mean);
  for (int i = 0; i < most_steps && residual > settled; ++i) {
    const double length = norm(step);
    if (length < 1e-17) break;
    if (length > 0.5) step = (0.5 / length) * step;
    const Quat next = normalized(mean * exp(step));
    // Newton's method squares the residual, so the last step needs no further pass to be sure of.
    if (residual < 1e-9) {
      mean = next;
      residual *= residual;
      break;
    }
    const Logs there = logs_around(next, rotations);
    // Where a rotation comes to lie opposite the mean the distance has a kink, and a step may have gone over
    // it.
    if (there.square > logs.square * (1 + 1e-14)) {
      step = 0.5 * step;
      continue;
    }
    mean = next;
    logs = there;
    residual = norm(logs.mean);
    step = newton_step(logs.hessian, logs.mean);
  }
  out.mean = upper(mean);
  out.spread = std::sqrt(logs.square);
  out.residual = residual;
  return out;
}

QuaternionMean slerp_mean(const ConstQuatTrack& rotations) {
  QuaternionMean out;
  const std::size_t frames = rotations.x.size();
  if (frames == 0) return out;
  Quat mean = rotations[0];
  for (std::size_t n = 2; n <= frames; ++n) {
    mean = normalized(slerp(1.0 / static_cast<double>(n), mean, rotations[n - 1]));
  }
  const Logs logs = logs_around(mean, rotations);
  out.mean = upper(mean);
  out.spread = std::sqrt(logs.square);
  out.residual = norm(logs.mean);
  return out;
}

}  // namespace kinegraph
