#include "gui/curves/channel_plot.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/curves/axis.h"

namespace kinegraph {

ChannelPlot::ChannelPlot(Playback& playback, QWidget* parent)
    : QWidget(parent), playback_(playback), theme_(&dark_theme()) {
  setAccessibleName(tr("Channels over time"));
  connect(&playback_, &Playback::moved, this, qOverload<>(&QWidget::update));
}

void ChannelPlot::set_series(std::vector<PlotSeries> series, const QString& unit) {
  series_ = std::move(series);
  unit_ = unit;
  update();
}

void ChannelPlot::set_theme(const Theme& theme) {
  theme_ = &theme;
  update();
}

QRectF ChannelPlot::plot() const {
  return QRectF(rect()).adjusted(58, 30, -14, -28);
}

QColor ChannelPlot::color(const PlotSeries& series) const {
  const QColor colors[] = {theme_->right, theme_->good, theme_->left};
  QColor color = colors[series.hue % 3];
  if (series.source) color.setAlphaF(0.7f);
  return color;
}

double ChannelPlot::length() const {
  double longest = 0;
  for (const PlotSeries& one : series_)
    longest = std::max(longest, static_cast<double>(one.values.size()) / one.fps);
  return std::max(longest, 1e-3);
}

void ChannelPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme_->panel);
  const QRectF area = plot();
  if (series_.empty()) {
    painter.setPen(theme_->faint_text);
    painter.drawText(rect(), Qt::AlignCenter, tr("Evaluating…"));
    return;
  }
  float low = INFINITY, high = -INFINITY;
  for (const PlotSeries& one : series_)
    for (float v : one.values)
      if (std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
  if (!(low <= high)) low = high = 0;
  const float room = std::max(1e-4f, (high - low) * 0.06f);
  low -= room;
  high += room;
  const double seconds = length();
  const auto y_of = [&](double v) { return area.bottom() - (v - low) / (high - low) * area.height(); };
  const auto x_of = [&](double s) { return area.left() + s / seconds * area.width(); };
  paint_axis(painter, area, *theme_, seconds * playback_.fps(), low, high, unit_, tr("frame"));
  painter.setClipRect(area);
  for (bool source : {true, false})
    for (const PlotSeries& one : series_) {
      if (one.source != source) continue;
      // Of many frames a pixel only the extremes are drawn, so that peaks stay.
      const std::size_t count = one.values.size();
      const std::size_t step =
          std::max<std::size_t>(1, count / static_cast<std::size_t>(2 * area.width() + 1));
      QPolygonF line;
      for (std::size_t t = 0; t < count; t += step) {
        auto [least, most] =
            std::minmax_element(one.values.begin() + static_cast<std::ptrdiff_t>(t),
                                one.values.begin() + static_cast<std::ptrdiff_t>(std::min(count, t + step)));
        const double x = x_of(static_cast<double>(t) / one.fps);
        if (std::isfinite(*least)) line << QPointF(x, y_of(*least));
        if (step > 1 && std::isfinite(*most)) line << QPointF(x, y_of(*most));
      }
      painter.setPen(QPen(color(one), source ? 1.3 : 1.8, source ? Qt::DashLine : Qt::SolidLine));
      painter.drawPolyline(line);
    }
  const double now = x_of(playback_.time());
  painter.setPen(QPen(theme_->accent, 1.2));
  painter.drawLine(QPointF(now, area.top()), QPointF(now, area.bottom()));
  painter.setClipping(false);
  double x = area.left();
  for (const PlotSeries& one : series_) {
    painter.setPen(QPen(color(one), 2.5, one.source ? Qt::DotLine : Qt::SolidLine));
    painter.drawLine(QPointF(x, 15), QPointF(x + 16, 15));
    painter.setPen(theme_->text);
    const double wide = painter.fontMetrics().horizontalAdvance(one.name);
    if (x + 20 + wide > width()) break;
    painter.drawText(QRectF(x + 21, 4, wide + 4, 22), Qt::AlignVCenter, one.name);
    x += 21 + wide + 16;
  }
}

void ChannelPlot::mousePressEvent(QMouseEvent* event) {
  mouseMoveEvent(event);
}

void ChannelPlot::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton)) return;
  const QRectF area = plot();
  playback_.pause();
  playback_.set_time((event->position().x() - area.left()) / area.width() * length());
}

}  // namespace kinegraph
