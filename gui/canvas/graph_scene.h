// What the canvas shows, worked out from a document: boxes with ports and values, wires as polylines, frames
// and notes. Lengths are graph units: pixels at zoom 1. Positions are those saved under `ui`.
#pragma once
#include <QPolygonF>
#include <QRectF>
#include <QString>
#include <compare>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

struct ScenePort {
  std::string name;
  std::string
      type;  // the colour and shape: of an output what comes out, of an input the usual type; "" = any
  QString help;
  QPointF at;  // relative to the node's top left
  bool list = false, optional = false, linked = false;
  bool operator==(const ScenePort&) const = default;
};

struct SceneValue {  // a parameter shown on the node
  QString name, value;
  bool operator==(const SceneValue&) const = default;
};

struct SceneNode {
  std::string name, type, category;
  QRectF rect;
  std::vector<ScenePort> inputs, outputs;  // those shown
  std::vector<SceneValue> values;
  int hidden_ports = 0;  // behind "more"
  bool expandable = false, expanded = false;
  QRectF still;  // where a motion's still is drawn, relative to the node; null: it has none
  QRectF more;   // the row that shows and hides them, relative to the node
  bool enabled = true, missing = false, dot = false;
  bool effect = false;  // writes or checks: computed by Run alone
  QString note, color;

  const ScenePort* port(bool input, std::string_view port_name) const;
  // Drawn alike, wherever they stand.
  bool looks_like(const SceneNode& other) const;
};

struct SceneWire {
  std::string from, from_port, to, to_port;
  std::size_t index = 0;  // among the links of the input
  std::string type;
  QPolygonF line;
  QRectF bounds;
};

struct SceneFrame {
  std::string name;
  QString title, color;
  QRectF rect;  // around its nodes
  QRectF title_bar;
  std::vector<std::string> nodes;
};

struct SceneNote {
  std::string name;
  QString text;
  QRectF rect;
};

struct PortAt {  // a port found under the pointer
  std::string node, port;
  bool input = false;
  auto operator<=>(const PortAt&) const = default;
};

class GraphScene {
 public:
  static constexpr int step = 10;  // positions snap to it
  static constexpr int node_width = 180;

  // `expanded`: nodes that show all their ports. Gives the nodes that are new or look otherwise than before.
  std::vector<std::string> rebuild(const Document& document, const Registry& registry,
                                   const std::set<std::string>& expanded);

  const std::vector<SceneNode>& nodes() const { return nodes_; }
  const std::vector<SceneWire>& wires() const { return wires_; }
  const std::vector<SceneFrame>& frames() const { return frames_; }
  const std::vector<SceneNote>& notes() const { return notes_; }
  const SceneNode* node(const std::string& name) const;
  // The order of drawing, as indices of nodes(): what is raised lies on top, for the hand as for the eye.
  const std::vector<std::size_t>& order() const { return order_; }
  void raise(const std::set<std::string>& nodes);
  QRectF bounds() const;  // of everything; null when there is nothing
  QRectF bounds_of(const std::set<std::string>& nodes) const;

  // While nodes are dragged they are drawn elsewhere than they are saved.
  void shift(const std::set<std::string>& nodes, QPointF by);

  // Under a point; the topmost, and none that another node covers. `reach` in graph units.
  const SceneNode* node_at(QPointF at) const;
  std::optional<PortAt> port_at(QPointF at, double reach) const;
  const SceneWire* wire_at(QPointF at, double reach) const;
  const SceneFrame* frame_title_at(QPointF at) const;
  const SceneNote* note_at(QPointF at) const;
  std::vector<const SceneWire*> wires_crossing(QPointF a, QPointF b) const;
  QPointF port_position(const PortAt& port) const;

 private:
  void arrange_unplaced(const std::set<std::string>& nodes);
  void place_wires();
  void place_frames();
  std::size_t index_of(const std::string& name) const;

  std::vector<SceneNode> nodes_;
  std::map<std::string, std::size_t> by_name_;
  std::vector<std::size_t> order_;
  std::vector<SceneWire> wires_;
  std::vector<SceneFrame> frames_;
  std::vector<SceneNote> notes_;
};

// The curve of a wire from an output to an input.
QPolygonF wire_curve(QPointF from, QPointF to);
double distance_to(const QPolygonF& line, QPointF at);

// Positions of `ui` entries; nothing where there is none.
std::optional<QPointF> point_of(const Json* entry, std::string_view key);
Json json_of(QPointF point);                                    // rounded to whole numbers
QString shown_value(const ParamType& type, const Json& value);  // short, for the node's body

}  // namespace kinegraph
