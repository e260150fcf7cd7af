#include "gui/timeline/transport_icon.h"

#include <QPainter>
#include <QPainterPath>
#include <QPixmap>

namespace kinegraph {
namespace {

void triangle(QPainter& painter, double left, double tip) {
  QPolygonF corners;
  corners << QPointF(left, 3.5) << QPointF(tip, 9) << QPointF(left, 14.5);
  painter.drawPolygon(corners);
}

void bracket(QPainter& painter, const QColor& color, bool opens) {
  const double bar = opens ? 6 : 12, lip = opens ? 11 : 7;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(color, 2));
  painter.drawPolyline(QPolygonF() << QPointF(lip, 3.5) << QPointF(bar, 3.5) << QPointF(bar, 14.5)
                                   << QPointF(lip, 14.5));
}

QPixmap drawn(TransportIcon icon, const QColor& color, double pixel_ratio) {
  QPixmap pixmap(QSize(18, 18) * pixel_ratio);
  pixmap.setDevicePixelRatio(pixel_ratio);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  switch (icon) {
    case TransportIcon::play:
      triangle(painter, 4.5, 15);
      break;
    case TransportIcon::pause:
      painter.drawRect(QRectF(4.5, 3.5, 3.5, 11));
      painter.drawRect(QRectF(10.5, 3.5, 3.5, 11));
      break;
    case TransportIcon::forward:
      painter.drawRect(QRectF(3.5, 3.5, 2, 11));
      triangle(painter, 7.5, 15);
      break;
    case TransportIcon::back:
      painter.drawRect(QRectF(12.5, 3.5, 2, 11));
      triangle(painter, 10.5, 3);
      break;
    case TransportIcon::end:
      triangle(painter, 3, 9);
      triangle(painter, 8, 14);
      painter.drawRect(QRectF(14, 3.5, 2, 11));
      break;
    case TransportIcon::start:
      triangle(painter, 15, 9);
      triangle(painter, 10, 4);
      painter.drawRect(QRectF(2, 3.5, 2, 11));
      break;
    case TransportIcon::loop: {
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(color, 1.8));
      painter.drawArc(QRectF(3.5, 3.5, 11, 11), 70 * 16, 300 * 16);
      painter.setPen(Qt::NoPen);
      painter.setBrush(color);
      painter.drawPolygon(QPolygonF() << QPointF(9, 0.5) << QPointF(14, 4) << QPointF(9, 7.5));
      break;
    }
    case TransportIcon::in:
      bracket(painter, color, true);
      break;
    case TransportIcon::out:
      bracket(painter, color, false);
      break;
  }
  return pixmap;
}

}  // namespace

QIcon transport_icon(TransportIcon icon, const QColor& color, const QColor& unusable, double pixel_ratio) {
  QIcon both(drawn(icon, color, pixel_ratio));
  both.addPixmap(drawn(icon, unusable, pixel_ratio), QIcon::Disabled);
  return both;
}

}  // namespace kinegraph
