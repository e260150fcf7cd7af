#include "gui/curves/axis.h"

#include <QLocale>
#include <algorithm>
#include <cmath>

#include "gui/look/hairline.h"

namespace kinegraph {

double round_step(double length, int wanted) {
  const double least = std::max(1e-9, length / std::max(1, wanted));
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (double factor : {1.0, 2.0, 5.0})
    if (power * factor >= least) return power * factor;
  return power * 10;
}

QString plain_number(double value) {
  if (value < 0) return QChar(0x2212) + plain_number(-value);
  return std::abs(value) >= 1e7 ? QString::number(value, 'g', 3)
         : std::abs(value) >= 1000
             ? QLocale(QLocale::English).toString(static_cast<qlonglong>(std::llround(value)))
             : QString::number(value, 'g', 4);
}

void paint_axis(QPainter& painter, const QRectF& area, const Theme& theme, double frames, double low,
                double high, const QString& unit, const QString& across_name) {
  const double up = round_step(high - low, std::max(2, static_cast<int>(area.height() / 28)));
  for (double v = std::ceil(low / up) * up; v <= high; v += up) {
    const double y = area.bottom() - (v - low) / (high - low) * area.height();
    draw_hairline(painter, QPointF(area.left(), y), QPointF(area.right(), y), theme.line);
    painter.setPen(theme.faint_text);
    painter.drawText(QRectF(0, y - 9, area.left() - 6, 18), Qt::AlignRight | Qt::AlignVCenter,
                     plain_number(std::abs(v) < up / 1e6 ? 0.0 : v));
  }
  const double across = std::max(1.0, round_step(frames, static_cast<int>(area.width() / 80)));
  for (double frame = 0; frame <= frames; frame += across) {
    const double x = area.left() + frame / std::max(1.0, frames) * area.width();
    draw_hairline(painter, QPointF(x, area.bottom()), QPointF(x, area.bottom() + 4), theme.line);
    painter.setPen(theme.faint_text);
    const QString number = QString::number(std::llround(frame));
    const double wide = painter.fontMetrics().horizontalAdvance(number) + 2;
    // The last one stays inside.
    const double left = std::min(x - wide / 2, area.right() + 14 - wide);
    painter.drawText(QRectF(left, area.bottom() + 5, wide, 18), Qt::AlignHCenter | Qt::AlignTop, number);
  }
  painter.setPen(theme.faint_text);
  painter.drawText(QRectF(4, area.top() - 24, area.left() - 10, 18), Qt::AlignRight | Qt::AlignVCenter, unit);
  painter.drawText(QRectF(area.left() - 80, area.bottom() + 5, 66, 18), Qt::AlignRight | Qt::AlignTop,
                   across_name);
}

}  // namespace kinegraph
