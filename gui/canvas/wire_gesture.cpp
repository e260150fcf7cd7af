// Dragging a wire from either end: ports that fit light up, and one that doesn't says why.
#include "graph/links.h"
#include "gui/canvas/canvas_edits.h"
#include "gui/canvas/canvas_gesture.h"
#include "gui/canvas/graph_canvas.h"
#include "gui/canvas/node_painter.h"

namespace kinegraph {
namespace {

class DragWire : public CanvasGesture {
 public:
  DragWire(GraphCanvas& canvas, const PortAt& port) : CanvasGesture(canvas), from_(port) {
    const Document& document = canvas.session().document();
    if (port.input) {
      // A link that hangs on a single input comes off with the pointer.
      auto node = document.nodes.find(port.node);
      auto links = node->second.inputs.find(port.port);
      if (links != node->second.inputs.end() && !links->second.list && links->second.links.size() == 1) {
        picked_up_ = port;
        const Link& link = links->second.links.front();
        from_ = PortAt{link.node, link.port, false};
      }
    }
    find_fitting();
    end_ = canvas.to_view(canvas.scene().port_position(port));
  }

  void move(QPointF view) override {
    end_ = view;
    target_.reset();
    refusal_.clear();
    const QPointF at = canvas_.to_graph(view);
    const Document& document = canvas_.session().document();
    const Registry& registry = canvas_.session().registry();
    auto port = canvas_.scene().port_at(at, 14 / std::min(1.0, canvas_.zoom()));
    if (port && port->node == from_.node && port->port == from_.port && port->input == from_.input)
      port.reset();
    if (port && picked_up_ && *port == *picked_up_) {
      target_ = port;
    } else if (port) {
      refusal_ = objection(document, registry, from_, *port);
      if (refusal_.isEmpty()) target_ = port;
    } else if (const SceneNode* node = canvas_.scene().node_at(at); node && node->name != from_.node) {
      target_ = fitting_port(document, registry, from_, node->name);
      if (!target_)
        refusal_ = QObject::tr("%1 has no port that fits.").arg(QString::fromStdString(node->name));
    }
    if (!refusal_.isEmpty())
      canvas_.set_hint(refusal_, view, true);
    else if (target_)
      canvas_.set_hint(QString::fromStdString(target_->node + "." + target_->port), view, false);
    else
      canvas_.set_hint(picked_up_ ? QObject::tr("let go to take the link off")
                                  : QObject::tr("let go to choose a node that fits"),
                       view, false);
    canvas_.update();
  }

  void release(QPointF view) override {
    canvas_.set_hint({}, {}, false);
    Session& session = canvas_.session();
    if (picked_up_ && target_ && *target_ == *picked_up_) return;  // back where it was
    if (!refusal_.isEmpty()) return;
    if (picked_up_) {
      session.perform([&](const Document& document, const Registry& registry) {
        std::vector<EditStep> steps{[&](const Document& d, const Registry& r) {
          return disconnect(d, r, picked_up_->node, picked_up_->port);
        }};
        if (target_)
          steps.push_back(
              [&](const Document& d, const Registry& r) { return link_ports(d, r, from_, *target_); });
        return one_after_another(document, registry, target_ ? "Move a link" : "Take a link off", steps);
      });
      return;
    }
    if (target_) {
      session.perform(
          [&](const Document& d, const Registry& r) { return link_ports(d, r, from_, *target_); });
      return;
    }
    if (!QRectF(canvas_.rect()).contains(view)) return;
    const QPointF away = view - canvas_.to_view(canvas_.scene().port_position(from_));
    if (QPointF::dotProduct(away, away) > 20 * 20) canvas_.search_to_add(canvas_.to_graph(view), from_);
  }

  void cancel() override { canvas_.set_hint({}, {}, false); }

  bool follow() override {
    const auto is_there = [&](const PortAt& port) {
      const SceneNode* node = canvas_.scene().node(port.node);
      return node && node->port(port.input, port.port);
    };
    target_.reset();
    if (!is_there(from_) || (picked_up_ && !is_there(*picked_up_))) return false;
    find_fitting();
    return true;
  }

  void paint(QPainter& p) override {
    p.setRenderHint(QPainter::Antialiasing);
    const Theme& theme = canvas_.theme();
    const double zoom = canvas_.zoom();
    for (const PortAt& port : fitting_) {
      QColor halo = theme.accent;
      halo.setAlpha(port == target_ ? 200 : 90);
      p.setPen(Qt::NoPen);
      p.setBrush(halo);
      p.drawEllipse(canvas_.to_view(canvas_.scene().port_position(port)), 10 * std::max(zoom, 0.5),
                    10 * std::max(zoom, 0.5));
      const SceneNode* node = canvas_.scene().node(port.node);
      const ScenePort* spot = node ? node->port(port.input, port.port) : nullptr;
      if (spot)
        draw_port(p, canvas_.to_view(node->rect.topLeft() + spot->at), 5 * std::max(zoom, 0.5),
                  Theme::shape(spot->type), spot->type.empty() ? theme.wire : theme.port(spot->type),
                  theme.canvas, spot->linked);
    }
    QPointF start = canvas_.scene().port_position(from_);
    QPointF end = target_ ? canvas_.scene().port_position(*target_) : canvas_.to_graph(end_);
    const SceneNode* node = canvas_.scene().node(from_.node);
    const ScenePort* port = node ? node->port(from_.input, from_.port) : nullptr;
    QColor color = port && !port->type.empty() ? theme.port(port->type) : theme.wire;
    if (!refusal_.isEmpty()) color = theme.error;
    QPolygonF line;
    for (const QPointF& point : from_.input ? wire_curve(end, start) : wire_curve(start, end))
      line << canvas_.to_view(point);
    p.setBrush(Qt::NoBrush);
    p.setPen(QPen(color, 2.5, target_ || !refusal_.isEmpty() ? Qt::SolidLine : Qt::DashLine));
    p.drawPolyline(line);
  }
  Qt::CursorShape cursor() const override {
    return refusal_.isEmpty() ? Qt::CrossCursor : Qt::ForbiddenCursor;
  }

 private:
  void find_fitting() {
    const Document& document = canvas_.session().document();
    fitting_.clear();
    for (const SceneNode& node : canvas_.scene().nodes())
      for (const ScenePort& one : from_.input ? node.outputs : node.inputs) {
        const PortAt other{node.name, one.name, !from_.input};
        if (objection(document, canvas_.session().registry(), from_, other).isEmpty())
          fitting_.push_back(other);
      }
  }

  PortAt from_;
  std::optional<PortAt> picked_up_, target_;
  std::vector<PortAt> fitting_;
  QString refusal_;
  QPointF end_;
};

}  // namespace

std::unique_ptr<CanvasGesture> wire_gesture(GraphCanvas& canvas, const PortAt& port) {
  return std::make_unique<DragWire>(canvas, port);
}

}  // namespace kinegraph
