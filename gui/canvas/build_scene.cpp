// From a document to boxes: which ports and values a node shows, and where.
#include <QFileInfo>
#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/links.h"
#include "graph/nested.h"
#include "gui/canvas/arrange.h"
#include "gui/canvas/graph_scene.h"

namespace kinegraph {
namespace {

constexpr double title_height = 40;  // name and type
constexpr double row = 20;
constexpr double value_row = 17;
constexpr double still_height = 46;
constexpr std::size_t ports_shown_at_once = 4;  // a node with more shows the linked ones and the first
constexpr std::size_t values_shown = 3;

QString elided_number(double value) {
  return QString::fromStdString(shortest_number(std::round(value * 1e4) / 1e4));
}

// Which of a node's many ports are shown: linked ones, and the first where none is.
template <class Port>
std::vector<bool> shown_of(const std::vector<Port>& ports, const std::set<std::string>& linked, bool all) {
  std::vector<bool> shown(ports.size(), all || ports.size() <= ports_shown_at_once);
  bool any = false;
  for (std::size_t i = 0; i < ports.size(); ++i)
    if (linked.count(ports[i].name)) shown[i] = any = true;
  if (!any && !shown.empty()) shown[0] = true;
  return shown;
}

void add_values(SceneNode& scene, const Node& node, const NodeType& type) {
  for (const Param& param : type.params) {
    if (scene.values.size() == values_shown) break;
    auto stored = node.params.find(param.name);
    const bool first_file =
        (param.kind == ParamType::Kind::open_file || param.kind == ParamType::Kind::save_file) &&
        param.name == "file";
    if (stored == node.params.end() && !first_file) continue;
    SceneValue value{QString::fromStdString(param.name),
                     stored == node.params.end() ? QString() : shown_value(param, stored->second)};
    if (value.value.isEmpty()) value.value = first_file ? QObject::tr("choose a file…") : QString("—");
    scene.values.push_back(value);
  }
}

}  // namespace

std::optional<QPointF> point_of(const Json* entry, std::string_view key) {
  const Json* point = entry ? entry->find(key) : nullptr;
  if (!point || !point->is_array() || point->array().size() != 2 || !point->array()[0].is_number() ||
      !point->array()[1].is_number())
    return {};
  return QPointF(point->array()[0].number(), point->array()[1].number());
}

Json json_of(QPointF point) {
  return Json::Array{std::round(point.x()), std::round(point.y())};
}

QString entries(std::size_t count) {
  return count == 1 ? QObject::tr("1 entry") : QObject::tr("%1 entries").arg(count);
}

QString shown_value(const ParamType& type, const Json& value) {
  using Kind = ParamType::Kind;
  const QString unit = type.unit.empty() ? QString() : " " + QString::fromStdString(type.unit);
  if (value.is_number()) return elided_number(value.number()) + unit;
  if (value.is_boolean()) return value.boolean() ? QObject::tr("on") : QObject::tr("off");
  if (value.is_string()) {
    const QString text = QString::fromStdString(value.string());
    if (type.kind == Kind::open_file || type.kind == Kind::save_file) return QFileInfo(text).fileName();
    return text;
  }
  if (type.kind == Kind::range && value.is_array() && value.array().size() == 2) {
    const auto part = [](const Json& one) {
      return one.is_number() ? elided_number(one.number()) : QObject::tr("end");
    };
    return part(value.array()[0]) + " – " + part(value.array()[1]);
  }
  if (value.is_array()) {
    if (value.array().size() == 1 && value.array()[0].is_string())
      return QString::fromStdString(value.array()[0].string());
    return entries(value.array().size());
  }
  if (value.is_object()) return entries(value.object().size());
  return {};
}

std::vector<std::string> GraphScene::rebuild(const Document& document, const Registry& registry,
                                             const std::set<std::string>& expanded) {
  const std::vector<SceneNode> old_nodes = std::exchange(nodes_, {});
  const auto old_by_name = std::exchange(by_name_, {});
  wires_.clear();
  frames_.clear();
  notes_.clear();
  std::map<std::string, std::set<std::string>> linked_from;
  for (const auto& [name, node] : document.nodes)
    for (const auto& [port, inputs] : node.inputs)
      for (const Link& link : inputs.links) linked_from[link.node].insert(link.port);

  std::set<std::string> unplaced;
  for (const auto& [name, node] : document.nodes) {
    SceneNode scene;
    scene.name = name;
    scene.type = node.type;
    scene.enabled = node.enabled;
    scene.note = QString::fromStdString(node.note);
    const NodeType* type = known_type(registry, node);
    scene.missing = !type;
    scene.dot = type && type->role == Role::pass;
    scene.effect = type && type->effect != Effect::none;
    auto entry = document.ui.nodes.find(name);
    const Json* ui = entry == document.ui.nodes.end() ? nullptr : &entry->second;
    if (const Json* color = ui ? ui->find("color") : nullptr; color && color->is_string())
      scene.color = QString::fromStdString(color->string());
    QPointF pos;
    if (auto saved = point_of(ui, "pos")) {
      pos = *saved;
    } else {
      unplaced.insert(name);
    }
    const auto& outs = linked_from[name];
    std::set<std::string> ins;
    for (const auto& [port, inputs] : node.inputs)
      if (!inputs.links.empty()) ins.insert(port);
    const auto out_type = [&](const std::string& port) {
      return type_of_output(document, registry, {name, port, {}}).value_or("");
    };
    double y = title_height + row / 2 + 2;
    if (scene.dot) {
      scene.rect = QRectF(pos, QSizeF(20, 20));
      scene.inputs.push_back(
          {type->inputs[0].name, out_type(type->outputs[0].name), {}, {0, 10}, false, true, !ins.empty()});
      scene.outputs.push_back({type->outputs[0].name,
                               out_type(type->outputs[0].name),
                               {},
                               {20, 10},
                               false,
                               false,
                               !outs.empty()});
    } else {
      std::vector<ScenePort> all_in, all_out;
      std::vector<bool> in_shown, out_shown;
      scene.expanded = expanded.count(name) > 0;
      if (type) {
        scene.category = type->category;
        in_shown = shown_of(type->inputs, ins, scene.expanded);
        out_shown = shown_of(type->outputs, outs, scene.expanded);
        for (const InputPort& port : type->inputs)
          all_in.push_back({port.name,
                            port.types.empty() ? "" : port.types.front(),
                            QString::fromStdString(port.help),
                            {},
                            port.list,
                            port.optional,
                            ins.count(port.name) > 0});
        for (const OutputPort& port : type->outputs)
          all_out.push_back({port.name,
                             port.type.empty() ? out_type(port.name) : port.type,
                             QString::fromStdString(port.help),
                             {},
                             false,
                             false,
                             outs.count(port.name) > 0});
        // A Switch's inputs look like what is linked to them.
        for (ScenePort& port : all_in)
          if (port.type.empty() && !all_out.empty()) port.type = all_out.front().type;
        scene.expandable =
            type->inputs.size() > ports_shown_at_once || type->outputs.size() > ports_shown_at_once;
      } else {
        for (const std::string& port : ins) all_in.push_back({port, "", {}, {}, false, false, true});
        for (const std::string& port : outs) all_out.push_back({port, "", {}, {}, false, false, true});
        in_shown.assign(all_in.size(), true);
        out_shown.assign(all_out.size(), true);
      }
      std::size_t rows_in = 0, rows_out = 0;
      for (std::size_t i = 0; i < all_in.size(); ++i) {
        if (!in_shown[i]) {
          ++scene.hidden_ports;
          continue;
        }
        all_in[i].at = QPointF(0, y + row * double(rows_in++));
        scene.inputs.push_back(std::move(all_in[i]));
      }
      for (std::size_t i = 0; i < all_out.size(); ++i) {
        if (!out_shown[i]) {
          ++scene.hidden_ports;
          continue;
        }
        all_out[i].at = QPointF(node_width, y + row * double(rows_out++));
        scene.outputs.push_back(std::move(all_out[i]));
      }
      double height = title_height + 4 + row * double(std::max(rows_in, rows_out));
      if (scene.expandable) {
        scene.more = QRectF(0, height, node_width, 18);
        height += 18;
      }
      const bool moves = std::any_of(scene.outputs.begin(), scene.outputs.end(),
                                     [](const ScenePort& port) { return port.type == "Motion"; });
      if (moves) {
        scene.still = QRectF(8, height + 2, node_width - 16, still_height);
        height += still_height + 4;
      }
      if (type) add_values(scene, node, *type);
      if (!scene.values.empty()) height += 6 + value_row * double(scene.values.size());
      scene.rect = QRectF(pos, QSizeF(node_width, std::ceil((height + 6) / step) * step));
    }
    by_name_[name] = nodes_.size();
    nodes_.push_back(std::move(scene));
  }

  for (const auto& [name, node] : document.nodes)
    for (const auto& [port, inputs] : node.inputs)
      for (std::size_t i = 0; i < inputs.links.size(); ++i) {
        const Link& link = inputs.links[i];
        if (!by_name_.count(link.node)) continue;
        SceneWire wire{link.node, link.port, name, port, i, {}, {}, {}};
        if (const ScenePort* from = this->node(link.node)->port(false, link.port)) wire.type = from->type;
        wires_.push_back(std::move(wire));
      }
  for (const auto& [name, json] : document.ui.frames) {
    SceneFrame frame{name, {}, {}, {}, {}, {}};
    if (const Json* title = json.find("title"); title && title->is_string())
      frame.title = QString::fromStdString(title->string());
    if (const Json* color = json.find("color"); color && color->is_string())
      frame.color = QString::fromStdString(color->string());
    if (const Json* inside = json.find("nodes"); inside && inside->is_array())
      for (const Json& one : inside->array())
        if (one.is_string()) frame.nodes.push_back(one.string());
    frames_.push_back(std::move(frame));
  }
  for (const auto& [name, json] : document.ui.notes) {
    const QPointF size = point_of(&json, "size").value_or(QPointF(200, 80));
    SceneNote note{name, {}, QRectF(point_of(&json, "pos").value_or(QPointF()), QSizeF(size.x(), size.y()))};
    if (const Json* text = json.find("text"); text && text->is_string())
      note.text = QString::fromStdString(text->string());
    notes_.push_back(std::move(note));
  }
  raise({});
  place_wires();
  if (!unplaced.empty()) arrange_unplaced(unplaced);
  place_frames();
  std::vector<std::string> changed;
  for (const SceneNode& node : nodes_) {
    const auto old = old_by_name.find(node.name);
    if (old == old_by_name.end() || !node.looks_like(old_nodes[old->second])) changed.push_back(node.name);
  }
  return changed;
}

// Nodes that were never seen in an editor: in columns, below those that have a place.
void GraphScene::arrange_unplaced(const std::set<std::string>& nodes) {
  double bottom = 0;
  bool any = false;
  for (const SceneNode& node : nodes_)
    if (!nodes.count(node.name)) {
      bottom = any ? std::max(bottom, node.rect.bottom()) : node.rect.bottom();
      any = true;
    }
  for (const auto& [name, at] : arranged(*this, nodes))
    nodes_[by_name_.at(name)].rect.moveTopLeft(at + QPointF(0, any ? bottom + 60 : 0));
  place_wires();
}

}  // namespace kinegraph
