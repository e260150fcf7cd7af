#include "gui/canvas/canvas_edits.h"

#include <algorithm>
#include <cmath>

#include "graph/links.h"
#include "graph/nested.h"

namespace kinegraph {
namespace {

using Kind = Unit::Kind;

Json entry_of(const std::map<std::string, Json, std::less<>>& entries, const std::string& name) {
  auto found = entries.find(name);
  return found == entries.end() ? Json(Json::Object{}) : found->second;
}

Change change_of(const Document& document, Unit unit, std::optional<Json> after) {
  auto before = get(document, unit);
  return {std::move(unit), std::move(before), std::move(after)};
}

Json position(QPointF at) {
  const auto snapped = [](double x) { return std::round(x / GraphScene::step) * GraphScene::step; };
  return json_of({snapped(at.x()), snapped(at.y())});
}

Edit ui_edit(const Document& document, Kind kind, const std::string& name, const char* key, Json value,
             const std::string& title) {
  const auto& entries = kind == Kind::ui_note ? document.ui.notes : document.ui.frames;
  Json entry = entry_of(entries, name);
  entry.object()[key] = std::move(value);
  return set_unit(document, {kind, name, {}}, std::move(entry), title);
}

std::string fresh_decor(const std::map<std::string, Json, std::less<>>& taken, const char* start) {
  Document names;
  for (const auto& [name, entry] : taken) names.nodes[name];
  return fresh_name(names, start);
}

}  // namespace

Edit one_after_another(const Document& document, const Registry& registry, const std::string& title,
                       const std::vector<EditStep>& steps) {
  Document draft = document;
  Edit all{title, {}};
  for (const EditStep& step : steps) {
    const Edit edit = step(draft, registry);
    apply(draft, edit);
    all = combined(std::move(all), edit);
  }
  all.title = title;
  return all;
}

Edit keeping_places(const Document& document, const Registry& registry, const GraphScene& scene,
                    const EditStep& step) {
  std::map<std::string, QPointF> shown;
  for (const auto& [name, node] : document.nodes) {
    const auto entry = document.ui.nodes.find(name);
    const SceneNode* seen = scene.node(name);
    if (seen && (entry == document.ui.nodes.end() || !point_of(&entry->second, "pos")))
      shown[name] = seen->rect.topLeft();
  }
  if (shown.empty()) return step(document, registry);
  const Edit places = move_nodes(document, shown);
  Document draft = document;
  apply(draft, places);
  const Edit own = step(draft, registry);
  if (own.empty()) return own;
  Edit both = combined(places, own);
  both.title = own.title;
  return both;
}

Edit move_nodes(const Document& document, const std::map<std::string, QPointF>& positions) {
  Edit edit{positions.size() == 1 ? "Move " + positions.begin()->first
                                  : "Move " + std::to_string(positions.size()) + " nodes",
            {}};
  for (const auto& [name, at] : positions) {
    Json entry = entry_of(document.ui.nodes, name);
    Json pos = position(at);
    if (const Json* before = entry.find("pos"); before && *before == pos) continue;
    entry.object()["pos"] = std::move(pos);
    edit.changes.push_back(change_of(document, {Kind::ui_node, name, {}}, std::move(entry)));
  }
  return edit;
}

Edit set_color(const Document& document, const std::set<std::string>& nodes, const QString& color) {
  Edit edit{"Colour " + (nodes.size() == 1 ? *nodes.begin() : std::to_string(nodes.size()) + " nodes"), {}};
  for (const std::string& name : nodes) {
    Json entry = entry_of(document.ui.nodes, name);
    if (color.isEmpty())
      entry.object().erase("color");
    else
      entry.object()["color"] = color.toStdString();
    std::optional<Json> after;
    if (!entry.object().empty()) after = std::move(entry);
    if (after == get(document, {Kind::ui_node, name, {}})) continue;
    edit.changes.push_back(change_of(document, {Kind::ui_node, name, {}}, std::move(after)));
  }
  return edit;
}

Edit add_note(const Document& document, QPointF at, const QString& text, std::string* name) {
  *name = fresh_decor(document.ui.notes, "note");
  Json::Object note;
  note["pos"] = position(at);
  note["size"] = Json::Array{200, 80};
  note["text"] = text.toStdString();
  return set_unit(document, {Kind::ui_note, *name, {}}, Json(std::move(note)), "Add a note");
}

Edit set_note_text(const Document& document, const std::string& note, const QString& text) {
  return ui_edit(document, Kind::ui_note, note, "text", text.toStdString(), "Write a note");
}

Edit place_note(const Document& document, const std::string& note, QRectF rect) {
  Json entry = entry_of(document.ui.notes, note);
  entry.object()["pos"] = position(rect.topLeft());
  entry.object()["size"] = position({std::max(60.0, rect.width()), std::max(30.0, rect.height())});
  return set_unit(document, {Kind::ui_note, note, {}}, std::move(entry), "Move a note");
}

Edit add_frame(const Document& document, const std::set<std::string>& nodes, const QString& title,
               std::string* name) {
  *name = fresh_decor(document.ui.frames, "frame");
  Json::Array inside;
  for (const std::string& node : nodes) inside.push_back(node);
  Json::Object frame;
  frame["nodes"] = std::move(inside);
  frame["title"] = title.toStdString();
  return set_unit(document, {Kind::ui_frame, *name, {}}, Json(std::move(frame)), "Group in a frame");
}

Edit set_frame_title(const Document& document, const std::string& frame, const QString& title) {
  return ui_edit(document, Kind::ui_frame, frame, "title", title.toStdString(), "Name a frame");
}

Edit remove_decor(const Document& document, const std::set<std::string>& frames,
                  const std::set<std::string>& notes) {
  Edit edit{"Delete", {}};
  for (const std::string& name : frames)
    edit.changes.push_back(change_of(document, {Kind::ui_frame, name, {}}, std::nullopt));
  for (const std::string& name : notes)
    edit.changes.push_back(change_of(document, {Kind::ui_note, name, {}}, std::nullopt));
  return edit;
}

Edit add_new_node(const Document& document, const Registry& registry, const NewNode& node,
                  std::string* name) {
  *name = fresh_name(document, node.type);
  std::vector<EditStep> steps;
  steps.push_back([&](const Document& d, const Registry& r) { return add_node(d, r, *name, node.type); });
  steps.push_back([&](const Document& d, const Registry&) { return move_nodes(d, {{*name, node.at}}); });
  for (const auto& [param, value] : node.params)
    steps.push_back([&, param = param, value = value](const Document& d, const Registry& r) {
      return set_param(d, r, *name, param, value);
    });
  if (node.link)
    steps.push_back([&](const Document& d, const Registry& r) -> Edit {
      const auto port = fitting_port(d, r, *node.link, *name);
      return port ? link_ports(d, r, *node.link, *port) : Edit{};
    });
  return one_after_another(document, registry, "Add " + node.type, steps);
}

namespace {

// The output and the input of two ports, or nothing when both are of one kind.
std::optional<std::pair<Link, PortAt>> directed(const PortAt& a, const PortAt& b) {
  if (a.input == b.input) return {};
  const PortAt& from = a.input ? b : a;
  return std::pair(Link{from.node, from.port, {}}, a.input ? a : b);
}

}  // namespace

Edit link_ports(const Document& document, const Registry& registry, const PortAt& a, const PortAt& b) {
  const auto pair = directed(a, b);
  if (!pair)
    throw Failure(
        error("type-mismatch", a.input ? "two inputs can't be linked" : "two outputs can't be linked")
            .hinting("link an output to an input"));
  const auto& [from, to] = *pair;
  auto node = document.nodes.find(to.node);
  const NodeType* type = node == document.nodes.end() ? nullptr : known_type(registry, node->second);
  const InputPort* port = type ? type->find_input(to.port) : nullptr;
  std::vector<EditStep> steps;
  if (port && !port->list) {
    auto links = node->second.inputs.find(to.port);
    if (links != node->second.inputs.end() && !links->second.links.empty()) {
      if (links->second.links.front() == from) return {};
      steps.push_back(
          [&](const Document& d, const Registry& r) { return disconnect(d, r, to.node, to.port); });
    }
  }
  steps.push_back(
      [&](const Document& d, const Registry& r) { return connect(d, r, from, to.node, to.port); });
  return one_after_another(document, registry,
                           "Link " + from.node + "." + from.port + " to " + to.node + "." + to.port, steps);
}

QString objection(const Document& document, const Registry& registry, const PortAt& a, const PortAt& b) {
  const auto pair = directed(a, b);
  if (!pair) return a.input ? QObject::tr("Both are inputs.") : QObject::tr("Both are outputs.");
  const auto why = objection_to_link(document, registry, pair->first, pair->second.node, pair->second.port);
  if (!why) return {};
  return QString::fromStdString(why->message);
}

std::optional<PortAt> fitting_port(const Document& document, const Registry& registry, const PortAt& from,
                                   const std::string& node) {
  auto found = document.nodes.find(node);
  if (found == document.nodes.end() || found->second.missing || node == from.node) return {};
  const NodeType* type = known_type(registry, found->second);
  if (!type) return {};
  std::optional<PortAt> taken;  // only where no free one fits
  const auto try_port = [&](const std::string& name, bool input) {
    const PortAt port{node, name, input};
    if (!objection(document, registry, from, port).isEmpty()) return false;
    auto links = found->second.inputs.find(name);
    if (input && links != found->second.inputs.end() && !links->second.links.empty() && !links->second.list) {
      if (!taken) taken = port;
      return false;
    }
    taken = port;
    return true;
  };
  if (from.input) {
    for (const OutputPort& port : type->outputs)
      if (try_port(port.name, false)) return taken;
  } else {
    for (const InputPort& port : type->inputs)
      if (try_port(port.name, true)) return taken;
  }
  return taken;
}

std::vector<std::string> fitting_types(const Document& document, const Registry& registry,
                                       const PortAt& from) {
  std::vector<std::string> fitting;
  Document draft = document;
  const std::string probe = fresh_name(document, "probe");
  for (const std::string& type : registry.names()) {
    Node node;
    node.type = type;
    node.version = registry.find(type)->version;
    draft.nodes[probe] = node;
    if (fitting_port(draft, registry, from, probe)) fitting.push_back(type);
  }
  return fitting;
}

}  // namespace kinegraph
