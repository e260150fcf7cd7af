// Series over the frames of a clip, result over source, with the moment looked at. A click moves there.
#pragma once
#include <QColor>
#include <QString>
#include <QWidget>
#include <vector>

#include "gui/look/theme.h"
#include "gui/viewing/playback.h"

namespace kinegraph {

struct PlotSeries {
  QString name;               // "x"
  QString whose;              // the node or output it is of
  std::vector<float> values;  // one a frame
  double fps = 120;
  int hue = 0;          // 0, 1, 2: x, y, z
  bool source = false;  // drawn paler, behind
};

class ChannelPlot : public QWidget {
  Q_OBJECT

 public:
  explicit ChannelPlot(Playback& playback, QWidget* parent = nullptr);
  void set_series(std::vector<PlotSeries> series, const QString& unit);
  void set_theme(const Theme& theme);
  QSize minimumSizeHint() const override { return {200, 100}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  QRectF plot() const;
  QColor color(const PlotSeries& series) const;
  void paint_legend(QPainter& painter) const;
  double length() const;  // s

  Playback& playback_;
  const Theme* theme_;
  std::vector<PlotSeries> series_;
  QString unit_;
};

}  // namespace kinegraph
