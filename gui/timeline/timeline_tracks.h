// The painted part of the timeline: a ruler in frames or seconds, the played range, a row for each motion
// with bars where its feet are planted, and the lines of a time warp between two rows.
#pragma once
#include <QWidget>
#include <memory>
#include <vector>

#include "gui/look/theme.h"
#include "gui/viewer/shown_motion.h"
#include "gui/viewing/playback.h"
#include "nodes/time/warp.h"

namespace kinegraph {

class TimelineTracks : public QWidget {
  Q_OBJECT

 public:
  struct Row {
    QString name;
    QColor color;
    std::shared_ptr<const ShownMotion> motion;
    QString why_not = {};                           // why there is no motion, as a sentence
    std::shared_ptr<const Contacts> contacts = {};  // null: those found in the motion
  };

  explicit TimelineTracks(Playback& playback, QWidget* parent = nullptr);

  void set_rows(std::vector<Row> rows);
  // Lines from the first row's frames to the second's, or none. The warp lives as long as `alive`.
  void set_warp(std::shared_ptr<const Warp> warp);
  void set_theme(const Theme& theme);

  QSize sizeHint() const override { return {600, 120}; }
  QSize minimumSizeHint() const override { return {200, 70}; }
  // Where a frame of the clip lies across the widget.
  double x_of(double frame) const;
  double frame_at(double x) const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  enum class Drag { none, scrub, in, out, pan };
  // What a tool tip says there: row, frame, and the foot of the bar.
  QString told_at(QPointF at) const;
  // The badge with the frame that is shown; null: it lies outside.
  QRectF playhead() const;
  void paint_ruler(QPainter& painter);
  void paint_focus(QPainter& painter) const;
  void fit_gutter();
  bool any_motion() const;
  QString why_nothing() const;  // in words where no row has a motion, else ""
  void paint_row(QPainter& painter, const Row& row, const QRectF& where);
  void paint_warp(QPainter& painter, const QRectF& upper, const QRectF& lower);
  QRectF row_rect(std::size_t index) const;
  void keep_view_inside();
  int last_frame() const;

  Playback& playback_;
  const Theme* theme_;
  std::vector<Row> rows_;
  std::shared_ptr<const Warp> warp_;
  double first_ = 0, shown_ = 0;         // frames: left end and width of the view; shown_ 0 = everything
  double gutter_ = 96, lane_names_ = 0;  // pixels: left of the frames, and of that what the lanes' names need
  Drag drag_ = Drag::none;
  double dragged_from_ = 0;
};

}  // namespace kinegraph
