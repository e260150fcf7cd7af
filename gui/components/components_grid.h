// All components of an analysis as small playing figures with caption and signal. A click chooses one, with
// Ctrl or Shift several; the arrow keys walk, Space chooses.
#pragma once
#include <QElapsedTimer>
#include <QImage>
#include <QTimer>
#include <QVector3D>
#include <QWidget>
#include <memory>
#include <set>
#include <vector>

#include "gui/components/component_figures.h"
#include "gui/look/theme.h"
#include "gui/viewer/picture_maker.h"

namespace kinegraph {

class ComponentsGrid : public QWidget {
  Q_OBJECT

 public:
  explicit ComponentsGrid(QWidget* parent = nullptr);

  void set_picture(std::shared_ptr<const ComponentPicture> picture);
  // What the edits do to each component, shown on its tile ("x 0"); one text a component.
  void set_badges(std::vector<QString> badges);
  void set_theme(const Theme& theme);

  const std::set<int>& chosen() const { return chosen_; }  // from 0
  int current() const { return current_; }
  void choose(int component, bool also);
  QRect tile(int component) const;
  // How high what shows the grid is: one row of tiles fits in it where it isn't too low.
  void set_room(int height);

  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;
  QSize sizeHint() const override;

 signals:
  void chosen_changed();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void fit_tiles();
  int count() const { return picture_ ? static_cast<int>(picture_->figures.size()) : 0; }
  int columns(int width) const;
  int tile_width() const;
  QRect figure_part(const QRect& tile) const;
  void ask();
  void find_reach();
  void paint_signal(QPainter& painter, const ComponentFigure& figure, const QRectF& where);

  std::shared_ptr<const ComponentPicture> picture_;
  std::vector<QString> badges_;
  const Theme* theme_;
  PictureMaker maker_;
  std::vector<QVector3D> reach_;
  QImage image_;
  QTimer playing_;
  QElapsedTimer clock_;
  std::set<int> chosen_;
  int current_ = 0, tile_height_ = 212, room_ = 228;
  bool drawing_ = false;
};

}  // namespace kinegraph
