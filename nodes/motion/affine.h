// Affine maps of space: what glTF's 4×4 matrices are, without their last row.
#pragma once
#include <array>

#include "nodes/motion/rotation.h"

namespace kinegraph {

// p' = M p + t, where M is the first three columns of `rows` and t the last.
struct Affine {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  bool operator==(const Affine&) const = default;
};
inline Vec3 point(const Affine& a, Vec3 p) {
  auto along = [&](int i) {
    return a.rows[i][0] * p.x + a.rows[i][1] * p.y + a.rows[i][2] * p.z + a.rows[i][3];
  };
  return {along(0), along(1), along(2)};
}
// Of a direction or displacement: without t.
inline Vec3 direction(const Affine& a, Vec3 v) {
  auto along = [&](int i) { return a.rows[i][0] * v.x + a.rows[i][1] * v.y + a.rows[i][2] * v.z; };
  return {along(0), along(1), along(2)};
}
inline Affine operator*(const Affine& a, const Affine& b) {  // b first
  Affine out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      out.rows[i][j] = a.rows[i][0] * b.rows[0][j] + a.rows[i][1] * b.rows[1][j] +
                       a.rows[i][2] * b.rows[2][j] + (j == 3 ? a.rows[i][3] : 0);
  return out;
}
// Scales about the origin, then turns, then moves.
inline Affine affine(Vec3 move, Quat turned = {}, Vec3 scale = {1, 1, 1}) {
  Affine out;
  for (int j = 0; j < 3; ++j) {
    Vec3 axis;
    axis[j] = scale[j];
    axis = rotate(turned, axis);
    for (int i = 0; i < 3; ++i) out.rows[i][j] = axis[i];
  }
  for (int i = 0; i < 3; ++i) out.rows[i][3] = move[i];
  return out;
}
double determinant(const Affine& a);  // of M
Affine inverse(const Affine& a);      // of an invertible one

// A map as a move, a turn and scales along its own axes. Shear, where there is any, is lost; a mirroring map
// has one negative scale.
struct Decomposed {
  Vec3 move;
  Quat turned;
  Vec3 scale{1, 1, 1};
};
Decomposed decomposed(const Affine& a);

}  // namespace kinegraph
