// Nodes as pixmaps, one set a zoom step, so that panning and zooming draw pictures and no text.
#pragma once
#include <QElapsedTimer>
#include <QPixmap>
#include <map>
#include <string>

#include "gui/canvas/node_painter.h"

namespace kinegraph {

class NodePixmaps {
 public:
  static constexpr double margin = 8;  // graph units around a node, for its ports

  // Nodes look otherwise now: all of them, or one.
  void forget();
  void forget(const std::string& node);
  // `budget_ms`: how long new pictures may be drawn for until the next begin(); after that an old one is
  // scaled.
  void begin(double zoom, double device_ratio, double budget_ms);
  // Draws it with its top left at `at` (pixels of the widget).
  void draw(QPainter& painter, QPointF at, const SceneNode& node, const NodeStatus* status,
            std::optional<Severity> problem, const Theme& theme);
  bool ran_out() const { return ran_out_; }  // something was scaled: draw again when the view rests

 private:
  struct Picture {
    QPixmap pixmap;
    double zoom = 0;
    bool fresh = false;
  };
  std::map<std::string, Picture, std::less<>> pictures_;
  double zoom_ = 1, ratio_ = 1, budget_ms_ = 0;
  bool ran_out_ = false;
  QElapsedTimer clock_;
};

}  // namespace kinegraph
