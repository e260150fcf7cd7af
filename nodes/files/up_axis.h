// Between a file whose Z points up and the world here, whose Y does: a quarter turn about X, exact.
#pragma once
#include <span>

#include "nodes/motion/motion.h"

namespace kinegraph {

inline Vec3 y_up(Vec3 v, UpAxis from) {
  return from == UpAxis::y ? v : Vec3{v.x, v.z, -v.y};
}
inline Vec3 with_up(Vec3 v, UpAxis to) {
  return to == UpAxis::y ? v : Vec3{v.x, -v.z, v.y};
}
inline Quat y_up(Quat q, UpAxis from) {
  return from == UpAxis::y ? q : Quat{q.x, q.z, -q.y, q.w};
}
inline Quat with_up(Quat q, UpAxis to) {
  return to == UpAxis::y ? q : Quat{q.x, -q.z, q.y, q.w};
}

}  // namespace kinegraph
