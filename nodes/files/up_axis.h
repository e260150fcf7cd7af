// Between a file whose Z points up and the world here, whose Y does: x = Y, y = Z, z = X, exact. One rule for
// markers and motions, so that files of one lab lie together. It is how marker labs (Vicon) turn their captures
// when they solve them to skeletons: CMU's markers lie where their skeletons do only with it.
#pragma once
#include "nodes/motion/motion.h"

namespace kinegraph {

inline Vec3 y_up(Vec3 v, UpAxis from) {
  return from == UpAxis::y ? v : Vec3{v.y, v.z, v.x};
}
inline Vec3 with_up(Vec3 v, UpAxis to) {
  return to == UpAxis::y ? v : Vec3{v.z, v.x, v.y};
}
inline Quat y_up(Quat q, UpAxis from) {
  return from == UpAxis::y ? q : Quat{q.y, q.z, q.x, q.w};
}
inline Quat with_up(Quat q, UpAxis to) {
  return to == UpAxis::y ? q : Quat{q.z, q.x, q.y, q.w};
}

}  // namespace kinegraph
