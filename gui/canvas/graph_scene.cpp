#include "gui/canvas/graph_scene.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace kinegraph {

const ScenePort* SceneNode::port(bool input, std::string_view port_name) const {
  for (const ScenePort& one : input ? inputs : outputs)
    if (one.name == port_name) return &one;
  return nullptr;
}

bool SceneNode::looks_like(const SceneNode& other) const {
  const auto looks = [](const SceneNode& node) {
    return std::tie(node.name, node.type, node.category, node.inputs, node.outputs, node.values,
                    node.hidden_ports, node.expandable, node.expanded, node.still, node.more, node.enabled,
                    node.missing, node.dot, node.effect, node.note, node.color);
  };
  return rect.size() == other.rect.size() && looks(*this) == looks(other);
}

QPolygonF wire_curve(QPointF from, QPointF to) {
  const double reach = std::clamp(std::abs(to.x() - from.x()) * 0.5, 24.0, 160.0);
  // A wire that leads back swings out further, so that it can be followed round its nodes.
  const double pull = to.x() < from.x() ? std::max(reach, 60.0) : reach;
  const QPointF a = from + QPointF(pull, 0), b = to - QPointF(pull, 0);
  const int pieces = std::abs(to.y() - from.y()) < 1 && to.x() > from.x() ? 1 : 20;
  QPolygonF line;
  line.reserve(pieces + 1);
  for (int i = 0; i <= pieces; ++i) {
    const double t = double(i) / pieces, s = 1 - t;
    line << s * s * s * from + 3 * s * s * t * a + 3 * s * t * t * b + t * t * t * to;
  }
  return line;
}

double distance_to(const QPolygonF& line, QPointF at) {
  double best = 1e300;
  for (qsizetype i = 0; i + 1 < line.size(); ++i) {
    const QPointF d = line[i + 1] - line[i], v = at - line[i];
    const double length = QPointF::dotProduct(d, d);
    const double t = length > 0 ? std::clamp(QPointF::dotProduct(d, v) / length, 0.0, 1.0) : 0;
    best = std::min(best, QLineF(at, line[i] + t * d).length());
  }
  return best;
}

const SceneNode* GraphScene::node(const std::string& name) const {
  auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &nodes_[found->second];
}

QRectF GraphScene::bounds() const {
  QRectF all;
  for (const SceneNode& node : nodes_) all |= node.rect;
  for (const SceneFrame& frame : frames_) all |= frame.rect;
  for (const SceneNote& note : notes_) all |= note.rect;
  return all;
}

QRectF GraphScene::bounds_of(const std::set<std::string>& names) const {
  QRectF all;
  for (const std::string& name : names)
    if (const SceneNode* one = node(name)) all |= one->rect;
  return all;
}

QPointF GraphScene::port_position(const PortAt& port) const {
  const SceneNode* owner = node(port.node);
  if (!owner) return {};
  if (const ScenePort* spot = owner->port(port.input, port.port)) return owner->rect.topLeft() + spot->at;
  return {port.input ? owner->rect.left() : owner->rect.right(), owner->rect.top() + 20};
}

void GraphScene::place_wires() {
  for (SceneWire& wire : wires_) {
    wire.line = wire_curve(port_position({wire.from, wire.from_port, false}),
                           port_position({wire.to, wire.to_port, true}));
    wire.bounds = wire.line.boundingRect().adjusted(-4, -4, 4, 4);
  }
}

void GraphScene::place_frames() {
  for (SceneFrame& frame : frames_) {
    QRectF around;
    for (const std::string& name : frame.nodes)
      if (const SceneNode* one = node(name)) around |= one->rect;
    if (around.isNull()) continue;
    frame.rect = around.adjusted(-20, -44, 20, 20);
    frame.title_bar = QRectF(frame.rect.topLeft(), QSizeF(frame.rect.width(), 28));
  }
  std::erase_if(frames_, [](const SceneFrame& frame) { return frame.rect.isNull(); });
}

void GraphScene::shift(const std::set<std::string>& names, QPointF by) {
  for (const std::string& name : names)
    if (auto found = by_name_.find(name); found != by_name_.end()) nodes_[found->second].rect.translate(by);
  for (SceneWire& wire : wires_)
    if (names.count(wire.from) || names.count(wire.to)) {
      wire.line = wire_curve(port_position({wire.from, wire.from_port, false}),
                             port_position({wire.to, wire.to_port, true}));
      wire.bounds = wire.line.boundingRect().adjusted(-4, -4, 4, 4);
    }
  place_frames();
}

void GraphScene::raise(const std::set<std::string>& names) {
  order_.clear();
  for (const bool raised : {false, true})
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if ((names.count(nodes_[i].name) > 0) == raised) order_.push_back(i);
}

const SceneNode* GraphScene::node_at(QPointF at) const {
  for (auto one = order_.rbegin(); one != order_.rend(); ++one)
    if (nodes_[*one].rect.contains(at)) return &nodes_[*one];
  return nullptr;
}

std::optional<PortAt> GraphScene::port_at(QPointF at, double reach) const {
  // A node hides the ports of those below it.
  const auto is_covered = [&](std::size_t place, QPointF point) {
    for (std::size_t above = place + 1; above < order_.size(); ++above)
      if (nodes_[order_[above]].rect.contains(point)) return true;
    return false;
  };
  double best = reach;
  std::optional<PortAt> found;
  for (std::size_t place = 0; place < order_.size(); ++place) {
    const SceneNode& one = nodes_[order_[place]];
    if (!one.rect.adjusted(-reach, -reach, reach, reach).contains(at) || is_covered(place, at)) continue;
    for (bool input : {true, false})
      for (const ScenePort& port : input ? one.inputs : one.outputs) {
        const QPointF spot = one.rect.topLeft() + port.at;
        const double distance = QLineF(at, spot).length();
        if (distance >= best || is_covered(place, spot)) continue;
        best = distance;
        found = PortAt{one.name, port.name, input};
      }
  }
  return found;
}

const SceneWire* GraphScene::wire_at(QPointF at, double reach) const {
  const SceneWire* found = nullptr;
  double best = reach;
  for (const SceneWire& wire : wires_) {
    if (!wire.bounds.adjusted(-reach, -reach, reach, reach).contains(at)) continue;
    const double distance = distance_to(wire.line, at);
    if (distance < best) {
      best = distance;
      found = &wire;
    }
  }
  return found;
}

const SceneFrame* GraphScene::frame_title_at(QPointF at) const {
  for (auto one = frames_.rbegin(); one != frames_.rend(); ++one)
    if (one->title_bar.contains(at)) return &*one;
  return nullptr;
}

const SceneNote* GraphScene::note_at(QPointF at) const {
  for (auto one = notes_.rbegin(); one != notes_.rend(); ++one)
    if (one->rect.contains(at)) return &*one;
  return nullptr;
}

std::vector<const SceneWire*> GraphScene::wires_crossing(QPointF a, QPointF b) const {
  std::vector<const SceneWire*> crossed;
  const QLineF cut(a, b);
  for (const SceneWire& wire : wires_)
    for (qsizetype i = 0; i + 1 < wire.line.size(); ++i)
      if (cut.intersects(QLineF(wire.line[i], wire.line[i + 1])) == QLineF::BoundedIntersection) {
        crossed.push_back(&wire);
        break;
      }
  return crossed;
}

}  // namespace kinegraph
