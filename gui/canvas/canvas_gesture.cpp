// Moving the view, choosing, notes' sizes and cutting wires.
#include "gui/canvas/canvas_gesture.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "gui/canvas/canvas_edits.h"
#include "gui/canvas/graph_canvas.h"

namespace kinegraph {
namespace {

class Pan : public CanvasGesture {
 public:
  Pan(GraphCanvas& canvas, QPointF view) : CanvasGesture(canvas), last_(view) {}
  void move(QPointF view) override {
    canvas_.pan_by(view - last_);
    last_ = view;
  }
  void release(QPointF) override {}
  Qt::CursorShape cursor() const override { return Qt::ClosedHandCursor; }

 private:
  QPointF last_;
};

class BoxSelect : public CanvasGesture {
 public:
  BoxSelect(GraphCanvas& canvas, QPointF view, bool keep)
      : CanvasGesture(canvas), start_(canvas.to_graph(view)), end_(start_) {
    if (keep) before_ = canvas.session().selected();
  }
  void move(QPointF view) override {
    end_ = canvas_.to_graph(view);
    canvas_.update();
    if (QLineF(canvas_.to_view(start_), view).length() < 4) return;
    select();
  }
  void release(QPointF view) override {
    if (QLineF(canvas_.to_view(start_), view).length() < 4) {
      canvas_.session().select(before_);
      canvas_.select_decor({}, {});
    }
  }
  void paint(QPainter& p) override {
    const QRectF box = QRectF(canvas_.to_view(start_), canvas_.to_view(end_)).normalized();
    QColor fill = canvas_.theme().accent;
    fill.setAlpha(36);
    p.setPen(QPen(canvas_.theme().accent, 1));
    p.setBrush(fill);
    p.drawRect(box);
  }

 private:
  void select() {
    const QRectF box = QRectF(start_, end_).normalized();
    std::erase_if(before_, [&](const auto& name) { return !canvas_.scene().node(name); });
    std::set<std::string> inside = before_, notes;
    for (const SceneNode& node : canvas_.scene().nodes())
      if (box.intersects(node.rect)) inside.insert(node.name);
    for (const SceneNote& note : canvas_.scene().notes())
      if (box.intersects(note.rect)) notes.insert(note.name);
    canvas_.session().select(inside);
    canvas_.select_decor({}, notes);
  }
  QPointF start_, end_;
  std::set<std::string> before_;
};

class ResizeNote : public CanvasGesture {
 public:
  ResizeNote(GraphCanvas& canvas, QPointF view, std::string note)
      : CanvasGesture(canvas), start_(view), end_(view), note_(std::move(note)) {
    for (const SceneNote& one : canvas.scene().notes())
      if (one.name == note_) rect_ = one.rect;
  }
  void move(QPointF view) override {
    end_ = view;
    canvas_.update();
  }
  void release(QPointF view) override {
    end_ = view;
    if (start_ == end_) return;
    canvas_.session().perform(
        [&](const Document& d, const Registry&) { return place_note(d, note_, now()); });
  }
  void paint(QPainter& p) override {
    p.setPen(QPen(canvas_.theme().accent, 1, Qt::DashLine));
    p.setBrush(Qt::NoBrush);
    p.drawRect(QRectF(canvas_.to_view(now().topLeft()), canvas_.to_view(now().bottomRight())));
  }
  bool follow() override {
    const auto& notes = canvas_.scene().notes();
    return std::any_of(notes.begin(), notes.end(), [&](const auto& one) { return one.name == note_; });
  }
  Qt::CursorShape cursor() const override { return Qt::SizeFDiagCursor; }

 private:
  QRectF now() const {
    const QPointF by = (end_ - start_) / canvas_.zoom();
    return rect_.adjusted(0, 0, by.x(), by.y());
  }
  QPointF start_, end_;
  std::string note_;
  QRectF rect_;
};

class Cut : public CanvasGesture {
 public:
  Cut(GraphCanvas& canvas, QPointF view) : CanvasGesture(canvas), line_{canvas.to_graph(view)} {}
  void move(QPointF view) override {
    const QPointF at = canvas_.to_graph(view);
    if (QLineF(canvas_.to_view(line_.back()), view).length() < 4) return;
    for (const SceneWire* wire : canvas_.scene().wires_crossing(line_.back(), at))
      cut_.insert({wire->to, wire->to_port, wire->index});
    line_ << at;
    canvas_.update();
  }
  void release(QPointF) override {
    if (cut_.empty()) return;
    canvas_.session().perform([&](const Document& document, const Registry& registry) {
      std::vector<EditStep> steps;
      // The last of a list first, so that the others keep their places.
      for (auto link = cut_.rbegin(); link != cut_.rend(); ++link)
        steps.push_back([link = *link](const Document& d, const Registry& r) {
          return disconnect(d, r, std::get<0>(link), std::get<1>(link), std::get<2>(link));
        });
      return one_after_another(
          document, registry,
          cut_.size() == 1 ? "Cut a link" : "Cut " + std::to_string(cut_.size()) + " links", steps);
    });
  }
  void paint_below(QPainter& p) override {
    p.setRenderHint(QPainter::Antialiasing);
    for (const SceneWire& wire : canvas_.scene().wires())
      if (cut_.count({wire.to, wire.to_port, wire.index})) {
        p.setPen(QPen(canvas_.theme().error, 3));
        draw(p, wire.line);
      }
  }
  void paint(QPainter& p) override {
    p.setRenderHint(QPainter::Antialiasing);
    p.setPen(QPen(canvas_.theme().error, 1.5, Qt::DashLine));
    draw(p, line_);
  }
  bool follow() override {
    const auto& wires = canvas_.scene().wires();
    std::erase_if(cut_, [&](const auto& link) {
      return std::none_of(wires.begin(), wires.end(), [&](const SceneWire& wire) {
        return link == std::tie(wire.to, wire.to_port, wire.index);
      });
    });
    return true;
  }
  Qt::CursorShape cursor() const override { return Qt::CrossCursor; }

 private:
  void draw(QPainter& p, const QPolygonF& line) {
    QPolygonF seen;
    for (const QPointF& point : line) seen << canvas_.to_view(point);
    p.drawPolyline(seen);
  }
  QPolygonF line_;
  std::set<std::tuple<std::string, std::string, std::size_t>> cut_;
};

}  // namespace

std::unique_ptr<CanvasGesture> pan_gesture(GraphCanvas& canvas, QPointF view) {
  return std::make_unique<Pan>(canvas, view);
}
std::unique_ptr<CanvasGesture> box_select_gesture(GraphCanvas& canvas, QPointF view, bool keep) {
  return std::make_unique<BoxSelect>(canvas, view, keep);
}
std::unique_ptr<CanvasGesture> resize_note_gesture(GraphCanvas& canvas, QPointF view,
                                                   const std::string& note) {
  return std::make_unique<ResizeNote>(canvas, view, note);
}
std::unique_ptr<CanvasGesture> cut_gesture(GraphCanvas& canvas, QPointF view) {
  return std::make_unique<Cut>(canvas, view);
}

}  // namespace kinegraph
