// Marks and paths of a scene as plain triangles, three points each.
#pragma once
#include <QtGlobal>
#include <vector>

#include "gui/viewer/scene.h"

namespace kinegraph {

struct FlatPoint {
  float x, y, z;
  quint8 r, g, b, a;
};
std::vector<FlatPoint> flat_marks(const Scene& scene);
// Ribbons that face the eye.
std::vector<FlatPoint> flat_paths(const Scene& scene, QVector3D eye);

}  // namespace kinegraph
