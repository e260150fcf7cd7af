#include "gui/curves/bar_plot.h"

#include <QPaintEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <map>

#include "gui/look/hairline.h"

namespace kinegraph {
namespace {
constexpr int row = 22, pad = 10;
}

BarPlot::BarPlot(QWidget* parent) : QWidget(parent), theme_(&dark_theme()) {
  setAccessibleName(tr("Numbers as bars"));
}

void BarPlot::set_bars(std::vector<PlotBar> bars, const QString& title) {
  bars_ = std::move(bars);
  title_ = title;
  updateGeometry();
  update();
}

void BarPlot::set_theme(const Theme& theme) {
  theme_ = &theme;
  update();
}

QSize BarPlot::sizeHint() const {
  return QSize(360, static_cast<int>(bars_.size() + 1) * row + 2 * pad);
}

void BarPlot::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(event->rect(), theme_->panel);
  // One zero for all of them, bars below it go to the left: each kind with the scale at which it fits.
  struct Scale {
    double most = 0, least = 0;
  };
  int name_width = 60, number_width = 40;
  std::map<QString, Scale> scales;
  bool any_below = false;
  for (const PlotBar& bar : bars_) {
    name_width = std::max(name_width, fontMetrics().horizontalAdvance(bar.name));
    number_width = std::max(number_width, fontMetrics().horizontalAdvance(bar.shown));
    if (!bar.value) continue;
    Scale& scale = scales[bar.group];
    scale.most = std::max(scale.most, *bar.value);
    scale.least = std::min(scale.least, *bar.value);
    any_below = any_below || *bar.value < 0;
  }
  name_width = std::min(name_width, width() / 2);
  const double left = pad + name_width + 12,
               room = std::max(20.0, width() - left - number_width - 2 * pad - 6);
  const double below = any_below ? 0.25 * room : 0, above = room - below, zero = left + below;
  painter.setPen(theme_->faint_text);
  painter.drawText(QRectF(left, pad, width() - left - pad, row), Qt::AlignLeft | Qt::AlignVCenter,
                   fontMetrics().elidedText(title_, Qt::ElideRight, static_cast<int>(width() - left - pad)));
  const double bottom = pad + static_cast<double>(bars_.size() + 1) * row;
  draw_hairline(painter, QPointF(zero, pad + row), QPointF(zero, bottom), theme_->line);
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const PlotBar& bar = bars_[i];
    const double top = pad + static_cast<double>(i + 1) * row;
    painter.setPen(theme_->text);
    painter.drawText(QRectF(pad, top, name_width, row), Qt::AlignRight | Qt::AlignVCenter,
                     fontMetrics().elidedText(bar.name, Qt::ElideMiddle, name_width));
    double end = zero;
    const Scale& scale = scales[bar.group];
    if (bar.value && *bar.value != 0) {
      double pixels = 1e300;
      if (scale.most > 0) pixels = above / scale.most;
      if (scale.least < 0) pixels = std::min(pixels, below / -scale.least);
      const double length = std::max(1.0, std::abs(*bar.value) * pixels);
      const bool negative = *bar.value < 0;
      painter.setPen(Qt::NoPen);
      painter.setBrush(theme_->port("Stats"));
      painter.drawRoundedRect(QRectF(negative ? zero - length : zero, top + 5, length, row - 10), 2, 2);
      if (!negative) end += length;
    }
    painter.setPen(bar.value ? theme_->text : theme_->faint_text);
    painter.drawText(QRectF(end + 6, top, number_width + 20, row), Qt::AlignVCenter, bar.shown);
  }
}

}  // namespace kinegraph
