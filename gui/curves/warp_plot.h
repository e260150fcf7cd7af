// A time warp: which frame of the source goes with which of the reference, over how far apart their poses
// are, and the energy over the rounds of the search.
#pragma once
#include <QImage>
#include <QThreadPool>
#include <QWidget>
#include <memory>

#include "gui/look/theme.h"
#include "gui/viewer/shown_motion.h"
#include "gui/viewing/playback.h"
#include "nodes/time/warp.h"

namespace kinegraph {

class WarpPlot : public QWidget {
  Q_OBJECT

 public:
  explicit WarpPlot(Playback& playback, QWidget* parent = nullptr);
  ~WarpPlot() override;
  void set_warp(std::shared_ptr<const Warp> warp);
  // The motions that were warped; the distances between their poses are found beside the window's thread.
  void set_motions(std::shared_ptr<const ShownMotion> source, std::shared_ptr<const ShownMotion> reference);
  void set_theme(const Theme& theme);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paint_path(QPainter& painter, const QRectF& area);
  void paint_scale(QPainter& painter, const QRectF& bar);
  void paint_energy(QPainter& painter, const QRectF& area);

  Playback& playback_;
  const Theme* theme_;
  std::shared_ptr<const Warp> warp_;
  std::shared_ptr<const ShownMotion> source_, reference_;
  QImage distances_;                   // grey: far = light
  double nearest_ = 0, farthest_ = 0;  // m between joints on the whole, at its ends
  QThreadPool pool_;
};

}  // namespace kinegraph
