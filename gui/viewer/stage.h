// The picture in the viewer: shows what the picture maker draws, and turns the camera with mouse and keys.
// Left drag orbits, middle or Shift-left drag pans, the wheel zooms; a drag on the wipe's line moves it.
#pragma once
#include <QImage>
#include <QTimer>
#include <QWidget>
#include <vector>

#include "gui/look/theme.h"
#include "gui/viewer/picture_maker.h"
#include "gui/viewer/scene.h"

namespace kinegraph {

class Stage : public QWidget {
  Q_OBJECT

 public:
  struct Caption {  // words in a corner of a cell
    QRectF cell;    // fractions
    QString words;
    QColor color;
    bool right = false;
  };

  explicit Stage(QWidget* parent = nullptr);

  // `moving`: more pictures follow at once, so that this one needn't be smooth.
  void show_cells(std::vector<SceneCell> cells, std::vector<Caption> captions, bool moving);
  void set_colors(const SceneColors& colors, const Theme& theme);
  void set_wipe(bool on);
  void set_legend(bool on);    // of the colours of stretched links
  double shape() const;        // of a cell: so many times as wide as high
  double cell_height() const;  // pixels
  double wipe() const { return wipe_; }

  OrbitCamera& camera() { return camera_; }
  void camera_changed();  // after camera() was changed from outside
  QImage picture_now(bool smooth);
  bool uses_opengl() const { return maker_.uses_opengl(); }
  // Pictures shown since the start: what a test measures.
  int pictures() const { return pictures_; }

 signals:
  void wipe_moved();
  void camera_moved();
  void clicked();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  ScenePicture picture(bool smooth) const;
  void paint_legend(QPainter& painter) const;
  void ask(bool moving);
  bool on_wipe_line(QPointF at) const;

  PictureMaker maker_;
  QImage image_;
  std::vector<SceneCell> cells_;
  std::vector<Caption> captions_;
  OrbitCamera camera_;
  SceneColors colors_;
  const Theme* theme_;
  QTimer rest_;
  QPointF last_;
  Qt::MouseButton button_ = Qt::NoButton;
  bool panning_ = false, wiping_ = false, has_wipe_ = false, has_legend_ = false;
  double wipe_ = 0.5;
  int pictures_ = 0;
};

}  // namespace kinegraph
