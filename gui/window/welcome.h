// What an empty graph says: how to begin, and the examples as small pictures of their graphs.
#pragma once
#include <QWidget>
#include <vector>

#include "gui/canvas/graph_scene.h"
#include "gui/window/theme.h"

class QPushButton;

namespace kinegraph {

class Welcome : public QWidget {
  Q_OBJECT

 public:
  // Lies over the canvas, in its middle; what isn't a card lets the mouse through to it.
  explicit Welcome(QWidget* canvas);
  void set_theme(const Theme& theme);
  void show_where(bool empty);

 signals:
  void chosen(const QString& path);

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();
  const Theme* theme_;
  std::vector<QPushButton*> cards_;
};

}  // namespace kinegraph
