#include "graph/file/units.h"

namespace kinegraph {

using Kind = Unit::Kind;

namespace {

template <class Map>
void add_keys(std::vector<Unit>& units, Kind kind, const std::string& name, const Map& map) {
  for (const auto& [key, value] : map) units.push_back({kind, name, key});
}
template <class Map>
void add_names(std::vector<Unit>& units, Kind kind, const Map& map) {
  for (const auto& [name, value] : map) units.push_back({kind, name, {}});
}

void add_parts_of_missing(std::vector<Unit>& units, const std::string& name, const Json::Object& whole) {
  for (const auto& [key, value] : whole) {
    if (key == "type" || key == "version") continue;
    if (key == "enabled")
      units.push_back({Kind::node_enabled, name, {}});
    else if (key == "note")
      units.push_back({Kind::node_note, name, {}});
    else if (key == "params" && value.is_object())
      add_keys(units, Kind::node_param, name, value.object());
    else if (key == "inputs" && value.is_object())
      add_keys(units, Kind::node_input, name, value.object());
    else
      units.push_back({Kind::node_extra, name, key});
  }
}

}  // namespace

std::vector<Unit> units_of_node(const Document& document, const std::string& name) {
  const auto found = document.nodes.find(name);
  if (found == document.nodes.end()) return {};
  const Node& node = found->second;
  std::vector<Unit> units{{Kind::node_type, name, {}}};
  if (node.missing && node.missing->is_object()) {
    add_parts_of_missing(units, name, node.missing->object());
    return units;
  }
  if (!node.enabled) units.push_back({Kind::node_enabled, name, {}});
  if (!node.note.empty()) units.push_back({Kind::node_note, name, {}});
  add_keys(units, Kind::node_param, name, node.params);
  for (const auto& [port, inputs] : node.inputs)
    if (!inputs.links.empty()) units.push_back({Kind::node_input, name, port});
  add_keys(units, Kind::node_extra, name, node.extras);
  return units;
}

std::vector<Unit> units_of_file(const Document& document) {
  std::vector<Unit> units;
  add_names(units, Kind::variable, document.variables);
  add_names(units, Kind::publish_input, document.publish.inputs);
  add_names(units, Kind::publish_output, document.publish.outputs);
  add_names(units, Kind::publish_param, document.publish.params);
  add_names(units, Kind::publish_extra, document.publish.extras);
  add_names(units, Kind::extra, document.extras);
  return units;
}

std::vector<Unit> units_of_ui(const Document& document) {
  std::vector<Unit> units;
  add_names(units, Kind::ui_frame, document.ui.frames);
  add_names(units, Kind::ui_node, document.ui.nodes);
  add_names(units, Kind::ui_note, document.ui.notes);
  add_names(units, Kind::ui_extra, document.ui.extras);
  return units;
}

bool same(const Node& a, const Node& b) {
  return a.type == b.type && a.version == b.version && a.enabled == b.enabled && a.note == b.note &&
         a.older == b.older && a.params == b.params && a.inputs == b.inputs && a.extras == b.extras &&
         a.missing == b.missing;
}

}  // namespace kinegraph
