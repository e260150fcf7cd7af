#include "gui/look/hairline.h"

#include <QTransform>
#include <algorithm>
#include <cmath>

namespace kinegraph {

QRectF on_pixels(const QPainter& painter, const QRectF& rect) {
  const QTransform to_device = painter.deviceTransform();
  const QRectF device = to_device.mapRect(rect);
  const double left = std::round(device.left()), top = std::round(device.top());
  const QRectF whole(left, top, std::max(1.0, std::round(device.right()) - left),
                     std::max(1.0, std::round(device.bottom()) - top));
  return to_device.inverted().mapRect(whole);
}

void draw_hairline(QPainter& painter, QPointF from, QPointF to, const QColor& color, double width) {
  const QTransform to_device = painter.deviceTransform();
  const QPointF a = to_device.map(from), b = to_device.map(to);
  const bool upright = std::abs(a.x() - b.x()) < std::abs(a.y() - b.y());
  // 1.5 pixels are one: thin lines must not look like thick ones.
  const double thick = std::max(1.0, std::floor(width * to_device.m11() + 1e-6));
  const QRectF line = upright ? QRectF(std::floor(a.x() - (thick - 1) / 2 + 1e-6), std::min(a.y(), b.y()),
                                       thick, std::abs(b.y() - a.y()))
                              : QRectF(std::min(a.x(), b.x()), std::floor(a.y() - (thick - 1) / 2 + 1e-6),
                                       std::abs(b.x() - a.x()), thick);
  painter.fillRect(to_device.inverted().mapRect(line), color);
}

void draw_hair_frame(QPainter& painter, const QRectF& around, const QColor& color) {
  const QRectF edge = on_pixels(painter, around);
  const double thick = std::max(1.0, std::floor(painter.deviceTransform().m11() + 1e-6)) /
                       std::max(1e-6, painter.deviceTransform().m11());
  painter.fillRect(QRectF(edge.left(), edge.top(), edge.width(), thick), color);
  painter.fillRect(QRectF(edge.left(), edge.bottom() - thick, edge.width(), thick), color);
  painter.fillRect(QRectF(edge.left(), edge.top() + thick, thick, edge.height() - 2 * thick), color);
  painter.fillRect(QRectF(edge.right() - thick, edge.top() + thick, thick, edge.height() - 2 * thick), color);
}

}  // namespace kinegraph
