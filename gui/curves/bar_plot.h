// Named numbers as horizontal bars: statistics of joints, metrics.
#pragma once
#include <QString>
#include <QWidget>
#include <optional>
#include <vector>

#include "gui/look/theme.h"

namespace kinegraph {

struct PlotBar {
  QString name, shown;          // shown: "12.3°"
  std::optional<double> value;  // nothing: not measured
  QString group;                // bars of a group share a scale
};

class BarPlot : public QWidget {
  Q_OBJECT

 public:
  explicit BarPlot(QWidget* parent = nullptr);
  void set_bars(std::vector<PlotBar> bars, const QString& title);
  void set_theme(const Theme& theme);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {200, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  const Theme* theme_;
  std::vector<PlotBar> bars_;
  QString title_;  // stands above them
};

}  // namespace kinegraph
