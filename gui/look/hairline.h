// Lines that stay sharp at any scale of the screen, also at 1.25 and 1.5: they lie on whole device pixels.
#pragma once
#include <QColor>
#include <QPainter>
#include <QPointF>
#include <QRectF>

namespace kinegraph {

// A level or upright line of about `width` logical pixels.
void draw_hairline(QPainter& painter, QPointF from, QPointF to, const QColor& color, double width = 1);
// A line of one pixel along the inside of a rectangle's edges.
void draw_hair_frame(QPainter& painter, const QRectF& around, const QColor& color);
// The rectangle with its edges on device pixels.
QRectF on_pixels(const QPainter& painter, const QRectF& rect);

}  // namespace kinegraph
