// The viewer's camera: it looks at a point from a distance and turns around it. Y is up, metres.
#pragma once
#include <QMatrix4x4>
#include <QPointF>
#include <QSizeF>
#include <QVector3D>
#include <optional>
#include <vector>

namespace kinegraph {

struct OrbitCamera {
  QVector3D target{0, 0.9f, 0};
  float distance = 4.5f;  // m
  float yaw = 0.6f;       // rad; 0 looks along -z, from the front of a body that faces +z
  float pitch = 0.22f;    // rad; positive looks down

  QVector3D eye() const;
  QMatrix4x4 view() const;
  QMatrix4x4 projection(QSizeF size) const;
  QVector3D right() const;
  QVector3D up() const;

  void orbit(QPointF pixels);                 // of the mouse
  void pan(QPointF pixels, double height);    // so that what is under the mouse stays there
  void zoom(double steps);                    // notches of a wheel; positive comes nearer
  void frame(QVector3D low, QVector3D high);  // shows the whole box from any side
  // As near as all points are seen whole from this side, with what is around them, in a picture so many
  // times as wide as high.
  // `headroom`: share of the height above it that stays free for captions.
  void frame_closely(const std::vector<QVector3D>& points, float thickness, double shape,
                     double headroom = 0.05);
  // Where a point of the world lies on a picture of this size, y down; nothing behind the eye.
  std::optional<QPointF> on_picture(QVector3D point, QSizeF size) const;
};

}  // namespace kinegraph
