#include "nodes/motion/affine.h"

namespace kinegraph {

namespace {

Vec3 column(const Affine& a, int j) {
  return {a.rows[0][j], a.rows[1][j], a.rows[2][j]};
}

// Of a rotation's columns; by the largest of w, x, y, z, so that nothing is divided by a small number.
Quat quat_of_axes(Vec3 x, Vec3 y, Vec3 z) {
  const double trace = x.x + y.y + z.z;
  Quat q;
  if (trace > 0) {
    q = {y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace};
  } else if (x.x >= y.y && x.x >= z.z) {
    q = {1 + x.x - y.y - z.z, x.y + y.x, z.x + x.z, y.z - z.y};
  } else if (y.y >= z.z) {
    q = {x.y + y.x, 1 - x.x + y.y - z.z, y.z + z.y, z.x - x.z};
  } else {
    q = {z.x + x.z, y.z + z.y, 1 - x.x - y.y + z.z, x.y - y.x};
  }
  return normalized(q);
}

}  // namespace

double determinant(const Affine& a) {
  return dot(column(a, 0), cross(column(a, 1), column(a, 2)));
}

Affine inverse(const Affine& a) {
  const Vec3 x = column(a, 0), y = column(a, 1), z = column(a, 2);
  const double size = determinant(a);
  const Vec3 rows[] = {cross(y, z) / size, cross(z, x) / size, cross(x, y) / size};
  Affine out;
  for (int i = 0; i < 3; ++i) out.rows[i] = {rows[i].x, rows[i].y, rows[i].z, -dot(rows[i], column(a, 3))};
  return out;
}

Decomposed decomposed(const Affine& a) {
  Vec3 x = column(a, 0), y = column(a, 1), z = column(a, 2);
  Decomposed out;
  out.move = column(a, 3);
  out.scale = {norm(x), norm(y), norm(z)};
  if (determinant(a) < 0) out.scale.x = -out.scale.x;
  if (out.scale.x == 0 || out.scale.y == 0 || out.scale.z == 0) return out;
  x = x / out.scale.x;
  y = normalized(y / out.scale.y - dot(x, y / out.scale.y) * x);
  out.turned = quat_of_axes(x, y, cross(x, y));
  return out;
}

}  // namespace kinegraph
