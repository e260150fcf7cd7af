// An orthographic camera: no foreshortening, so that lengths at any depth compare.
#pragma once
#include "headless/draws/canvas.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

class Camera {
 public:
  // Seen from the horizontal direction `from` (any length, y ignored), raised by `elevation` radians.
  // `scale`: points of the picture a metre.
  Camera(Vec3 from, double elevation, double scale);

  // The page position of a world point relative to the page position of the world's origin, which is (0, 0).
  Spot project(Vec3 world) const { return {scale_ * dot(right_, world), -scale_ * dot(up_, world)}; }
  double depth(Vec3 world) const { return dot(toward_, world); }  // larger is nearer to the viewer, m
  double scale() const { return scale_; }
  Vec3 right() const { return right_; }
  Vec3 up() const { return up_; }
  // How much a length on the floor that leads away from the viewer is flattened.
  double flattening() const { return toward_.y; }

 private:
  Vec3 right_, up_, toward_;
  double scale_;
};

}  // namespace kinegraph
