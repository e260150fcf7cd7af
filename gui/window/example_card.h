// A button that shows an example: a small picture of its graph, its name and what it is about.
#pragma once
#include <QPushButton>

#include "graph/registry.h"
#include "gui/canvas/graph_scene.h"
#include "gui/look/theme.h"

namespace kinegraph {

class ExampleCard : public QPushButton {
  Q_OBJECT

 public:
  static constexpr int wide = 190, high = 142;
  ExampleCard(const QString& path, const QString& about, const Registry& registry, QWidget* parent);
  void set_theme(const Theme& theme);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paint_graph(QPainter& painter, const QRectF& room) const;
  GraphScene graph_;
  QString title_, about_;
  const Theme* theme_;
};

}  // namespace kinegraph
