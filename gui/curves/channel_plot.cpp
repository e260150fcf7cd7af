#include "gui/curves/channel_plot.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/curves/axis.h"
#include "gui/look/hairline.h"

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
  draw_hairline(painter, QPointF(now, area.top()), QPointF(now, area.bottom()), theme_->accent, 1.4);
  painter.setClipping(false);
  paint_legend(painter);
}

// The channels by colour, then whose they are by the kind of line; what doesn't fit is shortened.
void ChannelPlot::paint_legend(QPainter& painter) const {
  struct Entry {
    QString words;
    QColor color;
    bool dashed;
  };
  std::vector<Entry> entries;
  for (const PlotSeries& one : series_)
    if (!one.source) entries.push_back({one.name, color(one), false});
  const auto source =
      std::find_if(series_.begin(), series_.end(), [](const auto& one) { return one.source; });
  if (source != series_.end()) {
    entries.push_back({series_.front().whose, theme_->text, false});
    entries.push_back({source->whose, theme_->faint_text, true});
  }
  double x = plot().left();
  constexpr double sample = 18, space = 6, between = 16;
  for (const Entry& entry : entries) {
    const double room = width() - 8 - x - sample - space;
    if (room < 24) break;
    painter.setPen(QPen(entry.color, entry.dashed ? 1.6 : 2.5, entry.dashed ? Qt::DashLine : Qt::SolidLine));
    painter.drawLine(QPointF(x, 15), QPointF(x + sample, 15));
    painter.setPen(theme_->text);
    const QString words =
        painter.fontMetrics().elidedText(entry.words, Qt::ElideRight, static_cast<int>(room));
    const double wide = painter.fontMetrics().horizontalAdvance(words);
    painter.drawText(QRectF(x + sample + space, 4, wide + 4, 22), Qt::AlignVCenter, words);
    x += sample + space + wide + between;
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
