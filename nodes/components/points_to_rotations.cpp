#include "nodes/components/points_to_rotations.h"

#include <algorithm>
#include <array>
#include <cmath>

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

}  // namespace

Quat best_rotation(const std::vector<Vec3>& from, const std::vector<Vec3>& to, Quat prior) {
  // S_ab = Σ from_a to_b. Three axes turned by the prior, with next to no weight, decide what collinear pairs
  // leave open.
  double s[3][3] = {};
  double size = 0;
  const auto add = [&](Vec3 a, Vec3 b, double weight) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) s[i][j] += weight * a[i] * b[j];
  };
  for (std::size_t i = 0; i < from.size(); ++i) {
    add(from[i], to[i], 1);
    size += norm(from[i]) * norm(to[i]);
  }
  for (Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    add(axis, rotate(prior, axis), 1e-10 * size);
  // Horn's matrix; its largest eigenvector is the quaternion (w, x, y, z).
  Matrix4 n{{{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
             {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
             {s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]},
             {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2]}}};
  const auto q = largest_eigenvector(n);
  return normalized(nearer(Quat{q[1], q[2], q[3], q[0]}, prior));
}

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
      if (known[child]) aims.push_back({child, through});
    } else {
      auto further = through;
      further.push_back(child);
      collect(child, further, known, aims);
    }
  }
}

void PointsToRotations::frame(const std::vector<Vec3>& positions, const std::vector<Quat>& base_local,
                              const std::vector<Quat>& base_world, std::vector<Quat>& world) const {
  std::vector<Vec3> from, to;
  for (int j = 0; j < skeleton_.size(); ++j) {
    from.clear();
    to.clear();
    for (const Aim& aim : aims_[j]) {
      const Vec3 link = positions[aim.target] - positions[j];
      const double length = norm(link);
      if (length < 1e-9) continue;
      Vec3 rest = skeleton_.joints[aim.target].offset;
      for (auto k = aim.through.rbegin(); k != aim.through.rend(); ++k) rest = rotate(base_local[*k], rest);
      from.push_back(rest);
      to.push_back(norm(rest) / length * link);
    }
    if (from.size() >= 2) {
      world[j] = best_rotation(from, to, base_world[j]);
    } else if (from.size() == 1) {
      world[j] = normalized(smallest_turn(rotate(base_world[j], from[0]), to[0]) * base_world[j]);
    } else {
      const int parent = skeleton_.joints[j].parent;
      world[j] = parent < 0 ? base_world[j] : world[parent] * base_local[j];
    }
  }
}

}  // namespace kinegraph
