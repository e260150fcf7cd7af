#include "nodes/components/points_to_rotations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nodes/motion/track_kernels.h"

namespace kinegraph {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

// The unit eigenvector of the largest eigenvalue of a symmetric 4 x 4 matrix, by cyclic Jacobi rotations.
std::array<double, 4> largest_eigenvector(Matrix4 a) {
  Matrix4 v{};
  for (int i = 0; i < 4; ++i) v[i][i] = 1;
  for (int sweep = 0; sweep < 12; ++sweep) {
    double off = 0, size = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) (i == j ? size : off) += a[i][j] * a[i][j];
    if (off <= 1e-32 * size) break;
    for (int p = 0; p < 3; ++p) {
      for (int q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 4; ++k) {
          const double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y;
          a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y;
          a[q][k] = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k) {
          const double x = v[k][p], y = v[k][q];
          v[k][p] = c * x - s * y;
          v[k][q] = s * x + c * y;
        }
      }
    }
  }
  int best = 0;
  for (int i = 1; i < 4; ++i)
    if (a[i][i] > a[best][best]) best = i;
  return {v[0][best], v[1][best], v[2][best], v[3][best]};
}

// The same where the eigenvector is nearer to (1, 0, 0, 0) than to its opposite: (1, x) with
// x = (λ - M)⁻¹ v for n = [n00 vᵀ; v M], λ by Newton's method on the secular equation λ = n00 + vᵀx. λ - M
// being positive definite, no other eigenvalue is larger. False where that isn't so.
bool leading_eigenvector(const Matrix4& n, Vec3& x) {
  const Vec3 v{n[1][0], n[2][0], n[3][0]};
  double lambda = n[0][0] + norm(v);
  for (int round = 0; round < 12; ++round) {
    // L D Lᵀ of λ - M.
    const double d0 = lambda - n[1][1];
    if (!(d0 > 0)) return false;
    const double l10 = -n[2][1] / d0, l20 = -n[3][1] / d0;
    const double d1 = lambda - n[2][2] - l10 * l10 * d0;
    if (!(d1 > 0)) return false;
    const double l21 = (-n[3][2] - l20 * l10 * d0) / d1;
    const double d2 = lambda - n[3][3] - l20 * l20 * d0 - l21 * l21 * d1;
    if (!(d2 > 0)) return false;
    const double y1 = v.y - l10 * v.x, y2 = v.z - l20 * v.x - l21 * y1;
    x.z = y2 / d2;
    x.y = y1 / d1 - l21 * x.z;
    x.x = v.x / d0 - l10 * x.y - l20 * x.z;
    const double off = lambda - n[0][0] - dot(v, x), step = off / (1 + dot(x, x));
    if (std::fabs(step) <= 1e-14 * std::fabs(lambda)) return dot(x, x) < 1e4;
    lambda -= step;
  }
  return false;
}

}  // namespace

Quat best_rotation(const std::vector<Vec3>& from, const std::vector<Vec3>& to, Quat prior) {
  const Quat back = inverse(prior);
  // All along one axis: that is aimed, and the turn about it is the prior's.
  const Vec3 axis = from.empty() ? Vec3{} : from.front();
  const double length = norm(axis);
  if (length > 0 && std::all_of(from.begin(), from.end(),
                                [&](Vec3 a) { return norm(cross(axis, a)) <= 1e-6 * length * norm(a); })) {
    Vec3 aim;
    for (std::size_t i = 0; i < from.size(); ++i) aim += dot(axis, from[i]) * to[i];
    const double size = norm(aim);
    if (size > 0)
      return normalized(nearer(prior * smallest_turn(axis / length, rotate(back, aim / size)), prior));
  }
  // S_ab = Σ from_a to_b, seen from the prior, so that the rotation wanted is a small one. The axes
  // themselves, with next to no weight, decide what collinear pairs leave open.
  double s[3][3] = {};
  double size = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 a = from[i], b = rotate(back, to[i]);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) s[row][column] += a[row] * b[column];
    size += norm(a) * norm(b);
  }
  for (int i = 0; i < 3; ++i) s[i][i] += 1e-10 * size;
  // Horn's matrix; its largest eigenvector is the quaternion (w, x, y, z).
  const Matrix4 n{{{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
                   {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
                   {s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]},
                   {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2]}}};
  Quat turn{0, 0, 0, 1};
  Vec3 x;
  if (leading_eigenvector(n, x)) {
    turn = normalized(Quat{x.x, x.y, x.z, 1});
  } else {
    const auto q = largest_eigenvector(n);
    turn = {q[1], q[2], q[3], q[0]};
  }
  return normalized(nearer(prior * turn, prior));
}

namespace {

// The smallest turn of `base` that aims what stands along `rest` along `link`, in the half-angle's form: the
// vector part is the axis's, the scalar 1 + cos. Lengths are those of the two.
Quat aimed(Quat base, Vec3 rest, double rest_length, Vec3 link, double link_length) {
  const Vec3 now = rotate(base, rest);
  const double lengths = rest_length * link_length, half = lengths + dot(now, link);
  // Nearly opposite ones take more care.
  if (!(half > 0.125 * lengths)) return normalized(smallest_turn(now, link) * base);
  const Vec3 axis = cross(now, link);
  return normalized(Quat{axis.x, axis.y, axis.z, half} * base);
}

}  // namespace

PointsToRotations::PointsToRotations(const Skeleton& skeleton, const std::vector<bool>& known,
                                     const std::vector<bool>& turning)
    : skeleton_(skeleton), aims_(skeleton.joints.size()) {
  for (int j = 0; j < skeleton.size(); ++j) {
    if (!known[j]) continue;
    std::vector<Aim> all, fixed;
    collect(j, {}, known, all);
    for (const Aim& aim : all)
      if (std::none_of(aim.through.begin(), aim.through.end(), [&](int k) { return turning[k]; }))
        fixed.push_back(aim);
    aims_[j] = fixed.empty() ? all : fixed;
  }
}

void PointsToRotations::collect(int joint, std::vector<int> through, const std::vector<bool>& known,
                                std::vector<Aim>& aims) const {
  for (int child : skeleton_.children(joint)) {
    if (skeleton_.link_length(child) > 1e-9) {
      if (known[child]) aims.push_back({child, skeleton_.link_length(child), through});
    } else {
      auto further = through;
      further.push_back(child);
      collect(child, further, known, aims);
    }
  }
}

void PointsToRotations::frames(const JointPositions& positions, const RootedPoses& base,
                               JointRotations& world) const {
  Pairs pairs;
  for (int j = 0; j < skeleton_.size(); ++j) {
    const std::vector<Aim>& aims = aims_[j];
    const QuatTrack out = world[j];
    const int parent = skeleton_.joints[j].parent;
    if (aims.empty() && parent >= 0) {
      compose_tracks(std::as_const(world)[parent], false, base.local[j], out);
      continue;
    }
    const bool is_single = aims.size() == 1 && aims[0].through.empty();
    std::size_t t = 0;
    while (t < base.frames()) {
      if (is_single)
        t = aim_tracks(std::as_const(base.world)[j], skeleton_.joints[aims[0].target].offset, aims[0].length,
                       positions[j], positions[aims[0].target], out, t);
      if (t < base.frames()) {
        out.set(t, orientation(j, t, positions, base, world, pairs));
        ++t;
      }
    }
  }
}

Quat PointsToRotations::orientation(int joint, std::size_t t, const JointPositions& positions,
                                    const RootedPoses& base, const JointRotations& world,
                                    Pairs& pairs) const {
  const std::vector<Aim>& aims = aims_[joint];
  const Vec3 start = positions[joint][t];
  const Quat before = base.world[joint][t];
  pairs.from.clear();
  pairs.to.clear();
  for (const Aim& aim : aims) {
    const Vec3 link = positions[aim.target][t] - start;
    const double length = norm(link);
    if (length < 1e-9) continue;
    if (aims.size() == 1) return aimed(before, rest_of(aim, base, t), aim.length, link, length);
    pairs.from.push_back(rest_of(aim, base, t));
    pairs.to.push_back(aim.length / length * link);
  }
  if (pairs.from.size() >= 2) return best_rotation(pairs.from, pairs.to, before);
  if (pairs.from.size() == 1)
    return normalized(smallest_turn(rotate(before, pairs.from[0]), pairs.to[0]) * before);
  const int parent = skeleton_.joints[joint].parent;
  return parent < 0 ? before : world[parent][t] * base.local[joint][t];
}

Vec3 PointsToRotations::rest_of(const Aim& aim, const RootedPoses& base, std::size_t t) const {
  Vec3 rest = skeleton_.joints[aim.target].offset;
  for (auto k = aim.through.rbegin(); k != aim.through.rend(); ++k) rest = rotate(base.local[*k][t], rest);
  return rest;
}

}  // namespace kinegraph
