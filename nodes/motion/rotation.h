// Vectors and rotations. Quaternions are Hamilton, unit, stored x y z w; v' = q v q⁻¹, child to parent,
// products right to left. log of a unit quaternion is the half-angle vector; a "turn" is the full angle.
#pragma once
#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace kinegraph {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const Vec3&) const = default;
};
inline Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(Vec3 a) {
  return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(double s, Vec3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Vec3 operator*(Vec3 a, double s) {
  return s * a;
}
inline Vec3 operator/(Vec3 a, double s) {
  return {a.x / s, a.y / s, a.z / s};
}
inline Vec3& operator+=(Vec3& a, Vec3 b) {
  return a = a + b;
}
inline Vec3& operator-=(Vec3& a, Vec3 b) {
  return a = a - b;
}
inline Vec3& operator*=(Vec3& a, double s) {
  return a = s * a;
}
inline double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) {
  return std::sqrt(dot(a, a));
}
inline Vec3 normalized(Vec3 a) {
  double n = norm(a);
  return n > 0 ? a / n : a;
}

struct Quat {
  double x = 0, y = 0, z = 0, w = 1;
  bool operator==(const Quat&) const = default;
};
inline Quat operator*(Quat a, Quat b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Quat operator-(Quat q) {
  return {-q.x, -q.y, -q.z, -q.w};
}
inline Quat inverse(Quat q) {
  return {-q.x, -q.y, -q.z, q.w};
}  // of a unit quaternion
inline double dot(Quat a, Quat b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
inline Quat normalized(Quat q) {
  double n = std::sqrt(dot(q, q));
  return n > 0 ? Quat{q.x / n, q.y / n, q.z / n, q.w / n} : Quat{};
}
inline Vec3 rotate(Quat q, Vec3 v) {
  Vec3 u{q.x, q.y, q.z};
  Vec3 t = 2 * cross(u, v);
  return v + q.w * t + cross(u, t);
}
// The one of q and -q that lies nearer to `reference`.
inline Quat nearer(Quat q, Quat reference) {
  return dot(q, reference) < 0 ? -q : q;
}

Vec3 log(
    Quat q);  // half-angle vector of q as it stands: |log| in [0, π]; log(-q) differs. Take nearer() first
Quat exp(Vec3 half_angle);
double turn(Quat a, Quat b);           // full angle between two orientations, [0, π]
double turn(Quat q);                   // full angle of a rotation, [0, π]
Quat slerp(double t, Quat a, Quat b);  // flips b if a·b < 0; extrapolates for t outside [0, 1]
Quat axis_angle(Vec3 unit_axis, double radians);
Quat about_y(double radians);  // R_y
Quat smallest_turn(
    Vec3 from,
    Vec3 to);  // the smallest rotation that takes one direction to the other; zero length: identity
// The twist of q about a unit axis; q = swing * twist. A swing of 180° has no twist: identity then.
Quat twist_about(Quat q, Vec3 unit_axis);
double heading_of(Quat q);  // 2 atan2(y, w), in (-π, π]: the twist about up

// Flips signs so that neighbours have a non-negative dot product. In place; frames.size() quaternions.
void make_continuous(std::span<double> x, std::span<double> y, std::span<double> z, std::span<double> w);

// Intrinsic Euler angles in the order of a BVH's channels: "ZYX" is R = Rz(a0) Ry(a1) Rx(a2). Also repeated
// or fewer axes.
struct EulerOrder {
  std::array<char, 3> axes{'Z', 'Y', 'X'};
};
Quat from_euler(std::string_view axes, const double* radians);  // any number of axes, left to right
// The solution nearest to `near` (radians, three numbers; null: nearest zero). Taken from the quaternion, not
// from a matrix; at the singular middle angle the first angle is `near`'s and the last makes up the rest.
// Three distinct axes.
std::array<double, 3> to_euler(Quat q, std::string_view axes, const double* near);

}  // namespace kinegraph
