// What the mouse does on the canvas from press to release, one class a gesture. Nothing is edited before the
// release, so that Escape can cancel, and each is one undo step.
#pragma once
#include <QPainter>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "gui/canvas/graph_scene.h"

namespace kinegraph {

class GraphCanvas;

class CanvasGesture {
 public:
  explicit CanvasGesture(GraphCanvas& canvas) : canvas_(canvas) {}
  virtual ~CanvasGesture() = default;
  // Positions are pixels of the widget.
  virtual void move(QPointF view) = 0;
  virtual void release(QPointF view) = 0;
  virtual void cancel() {}
  // The graph became another meanwhile, and the scene was made anew. False: there is nothing left to do it
  // to.
  virtual bool follow() { return true; }
  virtual void paint(QPainter&) {}
  virtual void paint_below(QPainter&) {}  // under the nodes, like wires
  // Not drawn meanwhile: the gesture takes it away.
  virtual bool hides(const SceneWire&) const { return false; }
  virtual Qt::CursorShape cursor() const { return Qt::ArrowCursor; }

 protected:
  GraphCanvas& canvas_;
};

std::unique_ptr<CanvasGesture> pan_gesture(GraphCanvas&, QPointF view);
// `keep`: what is selected already stays so.
std::unique_ptr<CanvasGesture> box_select_gesture(GraphCanvas&, QPointF view, bool keep);
// Moves nodes and notes; one node dropped on a wire is put into it. `take_out`: of its wires first.
std::unique_ptr<CanvasGesture> move_gesture(GraphCanvas&, QPointF view, std::set<std::string> nodes,
                                            std::set<std::string> notes, bool take_out);
std::unique_ptr<CanvasGesture> resize_note_gesture(GraphCanvas&, QPointF view, const std::string& note);
// From a port; a linked input gives up its link, which then hangs on the pointer.
std::unique_ptr<CanvasGesture> wire_gesture(GraphCanvas&, const PortAt& port);
std::unique_ptr<CanvasGesture> cut_gesture(GraphCanvas&, QPointF view);

}  // namespace kinegraph
