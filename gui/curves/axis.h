// The frame of a plot: lines at round numbers with their labels.
#pragma once
#include <QPainter>
#include <QRectF>
#include <QString>

#include "gui/look/theme.h"

namespace kinegraph {

// The step of 1, 2 or 5 times a power of ten that gives some `wanted` of them over a length.
double round_step(double length, int wanted);
// "1,250", "0.035"
QString plain_number(double value);
// 0 … `frames` across, called `across`; `low` … `high` up, in `unit`.
void paint_axis(QPainter& painter, const QRectF& area, const Theme& theme, double frames, double low,
                double high, const QString& unit, const QString& across);

}  // namespace kinegraph
