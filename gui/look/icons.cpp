#include "gui/look/icons.h"

#include <QPainter>
#include <QPainterPath>
#include <QPixmap>

namespace kinegraph {
namespace {

// In a square of 16 units.
void draw(QPainter& p, Sign sign, const Theme& theme) {
  switch (sign) {
    case Sign::run:
      p.setBrush(theme.good);
      p.setPen(Qt::NoPen);
      p.drawPolygon(QPolygonF({{4, 2.5}, {13.5, 8}, {4, 13.5}}));
      break;
    case Sign::stop:
      p.setBrush(p.pen().color());
      p.setPen(Qt::NoPen);
      p.drawRoundedRect(QRectF(4, 4, 8, 8), 1, 1);
      break;
    case Sign::undo:
    case Sign::redo: {
      if (sign == Sign::redo) {
        p.translate(16, 0);
        p.scale(-1, 1);
      }
      QPainterPath path(QPointF(3, 6.5));
      path.lineTo(10, 6.5);
      path.cubicTo(14.5, 6.5, 14.5, 13, 10, 13);
      path.lineTo(6, 13);
      p.drawPath(path);
      p.drawPolyline(QPolygonF({{6.5, 3}, {3, 6.5}, {6.5, 10}}));
      break;
    }
    case Sign::add:
      p.drawLine(QPointF(8, 3), QPointF(8, 13));
      p.drawLine(QPointF(3, 8), QPointF(13, 8));
      break;
    case Sign::theme:
      p.drawEllipse(QPointF(8, 8), 5, 5);
      p.setBrush(p.pen().color());
      p.drawChord(QRectF(3, 3, 10, 10), 90 * 16, 180 * 16);
      break;
    case Sign::graph:
      for (const QPointF& at : {QPointF(1.5, 2.5), QPointF(1.5, 9.5), QPointF(10, 6)})
        p.drawRoundedRect(QRectF(at, QSizeF(4.5, 4)), 0.8, 0.8);
      p.drawPolyline(QPolygonF({{6, 4.5}, {8, 4.5}, {8, 8}, {10, 8}}));
      p.drawPolyline(QPolygonF({{6, 11.5}, {8, 11.5}, {8, 8}}));
      break;
    case Sign::open:
    case Sign::folder:
      p.drawPolygon(QPolygonF({{2, 4}, {6, 4}, {7.5, 5.5}, {14, 5.5}, {14, 12.5}, {2, 12.5}}));
      break;
    case Sign::save:
      p.drawLine(QPointF(8, 2.5), QPointF(8, 9.5));
      p.drawPolyline(QPolygonF({{5, 7}, {8, 10}, {11, 7}}));
      p.drawPolyline(QPolygonF({{2.5, 10.5}, {2.5, 13.5}, {13.5, 13.5}, {13.5, 10.5}}));
      break;
    case Sign::reset:
      p.drawArc(QRectF(3.5, 3.5, 9, 9), 60 * 16, 280 * 16);
      p.drawPolyline(QPolygonF({{9.5, 1.8}, {10.6, 4.4}, {8, 5.6}}));
      break;
    case Sign::publish:
      p.drawEllipse(QPointF(4, 8), 2, 2);
      p.drawLine(QPointF(6.5, 8), QPointF(13, 8));
      p.drawPolyline(QPolygonF({{10, 5}, {13, 8}, {10, 11}}));
      break;
    case Sign::clip:
      p.drawEllipse(QPointF(8, 3.5), 1.7, 1.7);
      p.drawLine(QPointF(8, 5.5), QPointF(8, 9.5));
      p.drawPolyline(QPolygonF({{4, 7.5}, {8, 6.5}, {12, 7.5}}));
      p.drawPolyline(QPolygonF({{5, 14}, {8, 9.5}, {11, 14}}));
      break;
    case Sign::remove:
      p.drawLine(QPointF(4, 4), QPointF(12, 12));
      p.drawLine(QPointF(12, 4), QPointF(4, 12));
      break;
    case Sign::follow:
      p.drawEllipse(QPointF(8, 8), 4, 4);
      for (const QPointF& way : {QPointF(0, 1), QPointF(0, -1), QPointF(1, 0), QPointF(-1, 0)})
        p.drawLine(QPointF(8, 8) + 3 * way, QPointF(8, 8) + 6.5 * way);
      break;
    case Sign::frame:
      p.drawPolyline(QPolygonF({{2.5, 6}, {2.5, 2.5}, {6, 2.5}}));
      p.drawPolyline(QPolygonF({{10, 2.5}, {13.5, 2.5}, {13.5, 6}}));
      p.drawPolyline(QPolygonF({{13.5, 10}, {13.5, 13.5}, {10, 13.5}}));
      p.drawPolyline(QPolygonF({{6, 13.5}, {2.5, 13.5}, {2.5, 10}}));
      break;
    case Sign::eye: {
      QPainterPath lids(QPointF(1.5, 8));
      lids.cubicTo(5, 2.6, 11, 2.6, 14.5, 8);
      lids.cubicTo(11, 13.4, 5, 13.4, 1.5, 8);
      p.drawPath(lids);
      p.setBrush(p.pen().color());
      p.drawEllipse(QPointF(8, 8), 1.6, 1.6);
      break;
    }
    case Sign::file:
    case Sign::new_file:
      p.drawPolygon(QPolygonF({{3.5, 2}, {9, 2}, {12.5, 5.5}, {12.5, 14}, {3.5, 14}}));
      p.drawPolyline(QPolygonF({{9, 2}, {9, 5.5}, {12.5, 5.5}}));
      break;
    case Sign::computer:
      p.drawRoundedRect(QRectF(2, 3, 12, 8), 1, 1);
      p.drawLine(QPointF(5, 13.5), QPointF(11, 13.5));
      break;
    case Sign::home:
      p.drawPolyline(QPolygonF({{2, 8}, {8, 2.5}, {14, 8}}));
      p.drawPolyline(QPolygonF({{4, 7}, {4, 13.5}, {12, 13.5}, {12, 7}}));
      break;
    case Sign::back:
    case Sign::forward:
    case Sign::up:
      p.translate(8, 8);
      p.rotate(sign == Sign::up ? 90 : sign == Sign::forward ? 180 : 0);
      p.drawLine(QPointF(-5, 0), QPointF(5, 0));
      p.drawPolyline(QPolygonF({{-1, -4}, {-5, 0}, {-1, 4}}));
      break;
    case Sign::new_folder:
      p.drawPolyline(QPolygonF({{9, 12.5}, {2, 12.5}, {2, 4}, {6, 4}, {7.5, 5.5}, {14, 5.5}, {14, 8}}));
      p.drawLine(QPointF(12.5, 10), QPointF(12.5, 15));
      p.drawLine(QPointF(10, 12.5), QPointF(15, 12.5));
      break;
    case Sign::list:
      for (const QPointF& at : {QPointF(3, 3), QPointF(9, 3), QPointF(3, 9), QPointF(9, 9)})
        p.drawRect(QRectF(at, QSizeF(4, 4)));
      break;
    case Sign::details:
      for (const double y : {4.0, 8.0, 12.0}) {
        p.drawPoint(QPointF(2.5, y));
        p.drawLine(QPointF(5.5, y), QPointF(13.5, y));
      }
      break;
    case Sign::dock_out:
      p.drawRoundedRect(QRectF(6, 2.5, 7.5, 7.5), 1, 1);
      p.drawPolyline(QPolygonF({{3.5, 6}, {2.5, 6}, {2.5, 13.5}, {10, 13.5}, {10, 12.5}}));
      break;
    case Sign::keys:
      p.drawRoundedRect(QRectF(1.5, 4, 13, 8.5), 1.5, 1.5);
      for (const double x : {4.5, 8.0, 11.5}) p.drawPoint(QPointF(x, 7));
      p.drawLine(QPointF(5.5, 10), QPointF(10.5, 10));
      break;
    case Sign::info:
    case Sign::question:
    case Sign::warning:
    case Sign::error:
    case Sign::done: {
      // A badge in the colour of what is said, with its letter cut out of it.
      const QColor color = sign == Sign::error     ? theme.error
                           : sign == Sign::warning ? theme.warning
                           : sign == Sign::done    ? theme.good
                                                   : theme.accent;
      p.setPen(Qt::NoPen);
      p.setBrush(color);
      if (sign == Sign::warning) {
        // Told from an error by its shape as well.
        p.setPen(QPen(color, 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        p.drawPolygon(QPolygonF({{8, 2}, {14.6, 13.6}, {1.4, 13.6}}));
      } else {
        p.drawEllipse(QPointF(8, 8), 7, 7);
      }
      p.setPen(QPen(theme.window, 1.7, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      p.setBrush(Qt::NoBrush);
      if (sign == Sign::question) {
        QPainterPath hook(QPointF(5.9, 6.1));
        hook.cubicTo(5.9, 3.2, 10.3, 3.2, 10.2, 6);
        hook.cubicTo(10.1, 7.6, 8, 7.6, 8, 9.3);
        p.drawPath(hook);
        p.drawPoint(QPointF(8, 12));
      } else if (sign == Sign::done) {
        p.drawPolyline(QPolygonF({{4.8, 8.3}, {7.1, 10.6}, {11.2, 5.6}}));
      } else if (sign == Sign::info) {
        p.drawPoint(QPointF(8, 4.6));
        p.drawLine(QPointF(8, 7.6), QPointF(8, 11.6));
      } else {
        const double lower = sign == Sign::warning ? 1.2 : 0;
        p.drawLine(QPointF(8, 4.2 + lower), QPointF(8, 8.6 + lower));
        p.drawPoint(QPointF(8, 11.6 + lower));
      }
      break;
    }
    case Sign::tree:
      p.drawPolyline(QPolygonF({{3.5, 3}, {3.5, 12.5}, {7, 12.5}}));
      p.drawLine(QPointF(3.5, 7.5), QPointF(7, 7.5));
      p.drawLine(QPointF(9, 7.5), QPointF(13, 7.5));
      p.drawLine(QPointF(9, 12.5), QPointF(13, 12.5));
      break;
  }
}

}  // namespace

QIcon icon(Sign sign, const Theme& theme) {
  QIcon made;
  // In a chosen row as well: what Qt would make of it there is washed out.
  for (const auto mode : {QIcon::Normal, QIcon::Selected, QIcon::Disabled})
    for (const int size : {16, 24, 32, 48, 64}) {
      QPixmap pixmap(size, size);
      pixmap.fill(Qt::transparent);
      QPainter p(&pixmap);
      p.setRenderHint(QPainter::Antialiasing);
      p.scale(size / 16.0, size / 16.0);
      if (mode == QIcon::Disabled) p.setOpacity(0.35);
      p.setPen(QPen(theme.text, 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      draw(p, sign, theme);
      made.addPixmap(pixmap, mode);
    }
  return made;
}

}  // namespace kinegraph
