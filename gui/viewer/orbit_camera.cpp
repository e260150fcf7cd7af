#include "gui/viewer/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {
namespace {
constexpr float degrees = 57.29577951f;
constexpr float field_of_view = 35;  // degrees, of the shorter side

// Towards the eye, from its angles alone: the same wherever it looks at.
QVector3D away_of(const OrbitCamera& camera) {
  return QVector3D(std::cos(camera.pitch) * std::sin(camera.yaw), std::sin(camera.pitch),
                   std::cos(camera.pitch) * std::cos(camera.yaw));
}

}  // namespace

QVector3D OrbitCamera::eye() const {
  return target + distance * away_of(*this);
}

QMatrix4x4 OrbitCamera::view() const {
  QMatrix4x4 m;
  m.lookAt(eye(), target, QVector3D(0, 1, 0));
  return m;
}

QMatrix4x4 OrbitCamera::projection(QSizeF size) const {
  const float aspect = static_cast<float>(std::max(1.0, size.width()) / std::max(1.0, size.height()));
  float vertical = field_of_view;
  if (aspect < 1) vertical = 2 * degrees * std::atan(std::tan(field_of_view / degrees / 2) / aspect);
  QMatrix4x4 m;
  m.perspective(vertical, aspect, std::max(0.01f, distance * 0.02f), distance * 20 + 60);
  return m;
}

QVector3D OrbitCamera::right() const {
  return QVector3D(std::cos(yaw), 0, -std::sin(yaw));
}

QVector3D OrbitCamera::up() const {
  return QVector3D::crossProduct(away_of(*this), right());
}

void OrbitCamera::orbit(QPointF pixels) {
  yaw -= static_cast<float>(pixels.x()) * 0.008f;
  pitch = std::clamp(pitch + static_cast<float>(pixels.y()) * 0.008f, -1.5f, 1.5f);
}

void OrbitCamera::pan(QPointF pixels, double height) {
  const float metres =
      2 * distance * std::tan(field_of_view / degrees / 2) / static_cast<float>(std::max(1.0, height));
  target += metres * (static_cast<float>(-pixels.x()) * right() + static_cast<float>(pixels.y()) * up());
}

void OrbitCamera::zoom(double steps) {
  distance = std::clamp(distance * static_cast<float>(std::pow(0.88, steps)), 0.05f, 400.0f);
}

void OrbitCamera::frame(QVector3D low, QVector3D high) {
  target = (low + high) / 2;
  const float radius = std::max(0.05f, (high - low).length() / 2);
  // The field of view is that of the picture's shorter side, so the box fits whatever its shape.
  distance = radius / std::sin(field_of_view / degrees / 2) * 1.02f;
}

void OrbitCamera::frame_closely(const std::vector<QVector3D>& points, float thickness, double shape,
                                double headroom) {
  constexpr float edge = 0.05f;  // of a side, left free
  if (points.empty()) return;
  const float half = std::tan(field_of_view / degrees / 2), wide = static_cast<float>(shape);
  const float across = (shape >= 1 ? half * wide : half) * (1 - 2 * edge);
  const float upwards = shape >= 1 ? half : half / wide;
  const QVector3D away = away_of(*this), side = right(), top = up();
  // A point x aside and z nearer is inside where x - centre ≤ (distance - z) · slope, and alike on the other
  // side: of all such lines the outermost two bound the centre, and the distance where they meet.
  struct Extent {
    float slope_above, slope_below, above = -1e30f, below = -1e30f;
    void take(float x, float z, float thick) {
      above = std::max(above, x + thick + z * slope_above);
      below = std::max(below, -x + thick + z * slope_below);
    }
    float distance() const { return (above + below) / (slope_above + slope_below); }
    float centre(float at) const { return (above - at * slope_above + at * slope_below - below) / 2; }
  };
  Extent level{across, across};
  Extent upright{upwards * (1 - 2 * std::max(edge, static_cast<float>(headroom))), upwards * (1 - 2 * edge)};
  float nearest = -1e30f, farthest = 1e30f;
  const QVector3D origin = points.front();
  for (const QVector3D& point : points) {
    const QVector3D p = point - origin;
    const float z = QVector3D::dotProduct(p, away);
    level.take(QVector3D::dotProduct(p, side), z + thickness, thickness);
    upright.take(QVector3D::dotProduct(p, top), z + thickness, thickness);
    nearest = std::max(nearest, z);
    farthest = std::min(farthest, z);
  }
  // The target lies in the middle of the depth, so that the camera turns around it.
  const float middle = (nearest + farthest) / 2, from = std::max(level.distance(), upright.distance());
  target = origin + level.centre(from) * side + upright.centre(from) * top + middle * away;
  distance = std::max(0.1f, from - middle);
}

std::optional<QPointF> OrbitCamera::on_picture(QVector3D point, QSizeF size) const {
  const QVector4D clip = projection(size) * view() * QVector4D(point, 1);
  if (clip.w() <= 1e-4f) return {};
  return QPointF((clip.x() / clip.w() * 0.5 + 0.5) * size.width(),
                 (0.5 - clip.y() / clip.w() * 0.5) * size.height());
}

}  // namespace kinegraph
