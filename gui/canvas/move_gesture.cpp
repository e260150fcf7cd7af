// Moving nodes and notes; one node is put into the wire that it is dropped on, or taken out of its own.
#include <QLineF>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "gui/canvas/canvas_edits.h"
#include "gui/canvas/canvas_gesture.h"
#include "gui/canvas/graph_canvas.h"

namespace kinegraph {
namespace {

using LinkSet = std::set<std::pair<PortAt, PortAt>>;  // from an output to an input

LinkSet links_of(const Document& document) {
  LinkSet links;
  for (const auto& [name, node] : document.nodes)
    for (const auto& [port, inputs] : node.inputs)
      for (const Link& link : inputs.links) links.insert({{link.node, link.port, false}, {name, port, true}});
  return links;
}

class Move : public CanvasGesture {
 public:
  Move(GraphCanvas& canvas, QPointF view, std::set<std::string> nodes, std::set<std::string> notes,
       bool take_out)
      : CanvasGesture(canvas),
        start_(view),
        nodes_(std::move(nodes)),
        notes_(std::move(notes)),
        take_out_(take_out) {}

  void move(QPointF view) override {
    if (!moved_ && QLineF(start_, view).length() < 4) return;
    moved_ = true;
    const QPointF by = snapped(view);
    canvas_.scene().shift(nodes_, by - shifted_);
    shifted_ = by;
    const auto target = [](const std::optional<SceneWire>& wire) {
      return wire ? std::tuple(wire->to, wire->to_port, wire->index + 1)
                  : std::tuple<std::string, std::string, std::size_t>();
    };
    const auto before = target(wire_);
    find_wire();
    if (before != target(wire_) || (take_out_ && !foreseen_)) foresee();
    canvas_.update();
  }

  void release(QPointF) override {
    if (!moved_) return;
    const QPointF by = shifted_;
    const auto wire = wire_;
    canvas_.rebuild();
    canvas_.session().perform([&](const Document& document, const Registry& registry) {
      std::vector<EditStep> steps = taking_out();
      std::map<std::string, QPointF> positions;
      for (const std::string& name : nodes_)
        if (const SceneNode* node = canvas_.scene().node(name)) positions[name] = node->rect.topLeft() + by;
      steps.push_back([&](const Document& d, const Registry&) { return move_nodes(d, positions); });
      for (const SceneNote& note : canvas_.scene().notes())
        if (notes_.count(note.name))
          steps.push_back([&](const Document& d, const Registry&) {
            return place_note(d, note.name, note.rect.translated(by));
          });
      std::string title = nodes_.size() == 1
                              ? "Move " + *nodes_.begin()
                              : "Move " + std::to_string(nodes_.size() + notes_.size()) + " things";
      if (wire) {
        title = "Insert " + *nodes_.begin();
        steps.push_back(inserting(*wire));
      }
      return keeping_places(document, registry, canvas_.scene(), [&](const Document& d, const Registry& r) {
        return one_after_another(d, r, title, steps);
      });
    });
    canvas_.rebuild();
  }

  void cancel() override { canvas_.rebuild(); }

  bool follow() override {
    std::erase_if(nodes_, [&](const auto& name) { return !canvas_.scene().node(name); });
    wire_.reset();
    foreseen_ = false;
    links_ = {};
    if (moved_) canvas_.scene().shift(nodes_, shifted_);
    return !nodes_.empty() || !notes_.empty();
  }

  // The links as they will be, where letting go changes any.
  void paint_below(QPainter& p) override {
    p.setRenderHint(QPainter::Antialiasing);
    p.setPen(QPen(canvas_.theme().accent, std::max(2.0, 3 * canvas_.zoom())));
    for (const auto& [from, to] : links_.made) {
      QPolygonF line;
      for (const QPointF& point :
           wire_curve(canvas_.scene().port_position(from), canvas_.scene().port_position(to)))
        line << canvas_.to_view(point);
      p.drawPolyline(line);
    }
  }
  bool hides(const SceneWire& wire) const override {
    return !links_.gone.empty() && links_.gone.contains({PortAt{wire.from, wire.from_port, false},
                                                         PortAt{wire.to, wire.to_port, true}});
  }
  Qt::CursorShape cursor() const override { return moved_ ? Qt::SizeAllCursor : Qt::ArrowCursor; }

 private:
  QPointF snapped(QPointF view) const {
    const QPointF by = (view - start_) / canvas_.zoom();
    return {std::round(by.x() / GraphScene::step) * GraphScene::step,
            std::round(by.y() / GraphScene::step) * GraphScene::step};
  }
  std::vector<EditStep> taking_out() const {
    if (!take_out_ || nodes_.size() != 1) return {};
    return {
        [this](const Document& d, const Registry& r) { return kinegraph::take_out(d, r, *nodes_.begin()); }};
  }
  EditStep inserting(const SceneWire& wire) const {
    return [this, wire](const Document& d, const Registry& r) {
      return insert_on_link(d, r, *nodes_.begin(), wire.to, wire.to_port, wire.index);
    };
  }
  // Which links letting go now would make and take away.
  void foresee() {
    links_ = {};
    foreseen_ = true;
    std::vector<EditStep> steps = taking_out();
    if (wire_) steps.push_back(inserting(*wire_));
    if (steps.empty()) return;
    Session& session = canvas_.session();
    Document after = session.document();
    try {
      apply(after, one_after_another(after, session.registry(), {}, steps));
    } catch (const Failure&) {
      return;  // and letting go will say why
    }
    const LinkSet old = links_of(session.document()), fresh = links_of(after);
    std::set_difference(old.begin(), old.end(), fresh.begin(), fresh.end(),
                        std::inserter(links_.gone, links_.gone.end()));
    std::set_difference(fresh.begin(), fresh.end(), old.begin(), old.end(),
                        std::inserter(links_.made, links_.made.end()));
  }
  // The wire that a single, unlinked node would be put into where it lies now.
  void find_wire() {
    wire_.reset();
    if (nodes_.size() != 1) return;
    const SceneNode* node = canvas_.scene().node(*nodes_.begin());
    if (!node || node->missing) return;
    for (const SceneWire& wire : canvas_.scene().wires())
      if ((wire.from == node->name || wire.to == node->name) && !take_out_) return;
    const QRectF inner = node->rect.adjusted(10, 4, -10, -4);
    for (const SceneWire& wire : canvas_.scene().wires()) {
      if (wire.from == node->name || wire.to == node->name || !wire.bounds.intersects(inner)) continue;
      bool crosses = false;
      for (const QPointF& point : wire.line) crosses |= inner.contains(point);
      for (qsizetype i = 0; i + 1 < wire.line.size() && !crosses; ++i)
        crosses =
            QLineF(wire.line[i], wire.line[i + 1]).intersects(QLineF(inner.topLeft(), inner.bottomRight())) ==
            QLineF::BoundedIntersection;
      if (!crosses) continue;
      Session& session = canvas_.session();
      try {
        insert_on_link(session.document(), session.registry(), node->name, wire.to, wire.to_port, wire.index);
        wire_ = wire;
        return;
      } catch (const Failure&) {
        continue;  // it doesn't fit there
      }
    }
  }

  QPointF start_, shifted_;
  std::set<std::string> nodes_, notes_;
  bool take_out_, moved_ = false, foreseen_ = false;
  std::optional<SceneWire> wire_;
  struct {
    LinkSet made, gone;
  } links_;
};

}  // namespace

std::unique_ptr<CanvasGesture> move_gesture(GraphCanvas& canvas, QPointF view, std::set<std::string> nodes,
                                            std::set<std::string> notes, bool take_out) {
  return std::make_unique<Move>(canvas, view, std::move(nodes), std::move(notes), take_out);
}

}  // namespace kinegraph
