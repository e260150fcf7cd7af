#include "gui/viewer/flat_shapes.h"

#include <cmath>

namespace kinegraph {
namespace {

constexpr int corners = 32;

FlatPoint point_of(QVector3D at, QRgb color, float strength) {
  return {at.x(),
          at.y(),
          at.z(),
          static_cast<quint8>(qRed(color)),
          static_cast<quint8>(qGreen(color)),
          static_cast<quint8>(qBlue(color)),
          static_cast<quint8>(static_cast<float>(qAlpha(color)) * strength)};
}

}  // namespace

std::vector<FlatPoint> flat_marks(const Scene& scene) {
  std::vector<FlatPoint> out;
  for (const SceneMark& mark : scene.marks) {
    const auto rim = [&](int k, float share) {
      const float angle = 6.2831853f * static_cast<float>(k % corners) / corners;
      return mark.at + share * mark.radius * QVector3D(std::cos(angle), 0, std::sin(angle));
    };
    for (int k = 0; k < corners; ++k) {
      for (const QVector3D& at : {mark.at, rim(k, mark_inside), rim(k + 1, mark_inside)})
        out.push_back(point_of(at, mark.color, mark_strength));
      for (const QVector3D& at : {rim(k, mark_inside), rim(k, 1), rim(k + 1, mark_inside),
                                  rim(k + 1, mark_inside), rim(k, 1), rim(k + 1, 1)})
        out.push_back(point_of(at, mark.color, 1));
    }
  }
  return out;
}

std::vector<FlatPoint> flat_paths(const Scene& scene, QVector3D eye) {
  std::vector<FlatPoint> out;
  for (const ScenePath& path : scene.paths) {
    const std::size_t count = path.points.size();
    if (count < 2) continue;
    std::vector<QVector3D> sides(count);
    for (std::size_t i = 0; i < count; ++i) {
      const QVector3D along = path.points[std::min(i + 1, count - 1)] - path.points[i > 0 ? i - 1 : 0];
      sides[i] = QVector3D::crossProduct(along, eye - path.points[i]).normalized() * (path.width / 2);
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
      // Quick from nothing, so that most of it is seen.
      const auto share = [&](std::size_t at) {
        return path.strength * std::sqrt(static_cast<float>(at) / static_cast<float>(count - 1));
      };
      const float from = share(i), to = share(i + 1);
      const FlatPoint a = point_of(path.points[i] - sides[i], path.color, from);
      const FlatPoint b = point_of(path.points[i] + sides[i], path.color, from);
      const FlatPoint c = point_of(path.points[i + 1] - sides[i + 1], path.color, to);
      const FlatPoint d = point_of(path.points[i + 1] + sides[i + 1], path.color, to);
      for (const FlatPoint& p : {a, b, c, c, b, d}) out.push_back(p);
    }
  }
  return out;
}

}  // namespace kinegraph
