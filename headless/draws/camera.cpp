#include "headless/draws/camera.h"

#include "nodes/motion/elementary.h"

namespace kinegraph {

Camera::Camera(Vec3 from, double elevation, double scale) : scale_(scale) {
  Vec3 level = normalized(Vec3{from.x, 0, from.z});
  if (norm(level) == 0) level = {0, 0, 1};
  auto raised = sin_cos(elevation);
  toward_ = raised.cos * level + raised.sin * Vec3{0, 1, 0};
  right_ = normalized(cross(Vec3{0, 1, 0}, level));
  up_ = cross(toward_, right_);
}

}  // namespace kinegraph
