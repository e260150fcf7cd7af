#include "gui/curves/bar_plot.h"

#include <QPaintEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <map>

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
  int name_width = 60, number_width = 40;
  std::map<QString, double> most;
  for (const PlotBar& bar : bars_) {
    name_width = std::max(name_width, fontMetrics().horizontalAdvance(bar.name));
    number_width = std::max(number_width, fontMetrics().horizontalAdvance(bar.shown));
    if (bar.value) most[bar.group] = std::max(most[bar.group], std::abs(*bar.value));
  }
  name_width = std::min(name_width, width() / 2);
  const double left = pad + name_width + 8, room = std::max(20.0, width() - left - number_width - 2 * pad);
  painter.setPen(theme_->faint_text);
  painter.drawText(QRectF(left, pad, width() - left - pad, row), Qt::AlignLeft | Qt::AlignVCenter, title_);
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const PlotBar& bar = bars_[i];
    const double top = pad + static_cast<double>(i + 1) * row;
    painter.setPen(theme_->text);
    painter.drawText(QRectF(pad, top, name_width, row), Qt::AlignRight | Qt::AlignVCenter,
                     fontMetrics().elidedText(bar.name, Qt::ElideMiddle, name_width));
    double end = left;
    if (bar.value && most[bar.group] > 0) {
      const double length = std::abs(*bar.value) / most[bar.group] * room;
      painter.setPen(Qt::NoPen);
      painter.setBrush(*bar.value < 0 ? theme_->right : theme_->port("Stats"));
      painter.drawRoundedRect(QRectF(left, top + 5, std::max(1.0, length), row - 10), 2, 2);
      end += length;
    }
    painter.setPen(theme_->faint_text);
    painter.drawText(QRectF(end + 6, top, number_width + 20, row), Qt::AlignVCenter, bar.shown);
  }
}

}  // namespace kinegraph
