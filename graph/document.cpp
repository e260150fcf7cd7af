#include "graph/document.h"

#include <algorithm>
#include <stdexcept>

namespace kinegraph {

std::string to_text(const Link& link) {
  return link.node + "." + link.port;
}

std::optional<Link> link_from_text(std::string_view text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos) return {};
  const std::string_view node = text.substr(0, dot), port = text.substr(dot + 1);
  if (!is_node_name(node) || !is_node_name(port)) return {};
  return Link{std::string(node), std::string(port), {}};
}

bool is_node_name(std::string_view name) {
  const auto starts = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto goes_on = [&](char c) { return starts(c) || (c >= '0' && c <= '9') || c == '-'; };
  return !name.empty() && name.size() <= 64 && starts(name.front()) &&
         std::all_of(name.begin(), name.end(), goes_on);
}

bool is_extra_key(std::string_view key) {
  return key.starts_with("x-");
}

namespace {

Json links_to_json(const std::vector<Link>& links, bool list) {
  if (!list) return links.empty() ? Json("") : Json(to_text(links.front()));
  Json::Array array;
  for (const Link& link : links) array.push_back(to_text(link));
  return array;
}

std::vector<Link> links_from_json(const Json& json) {
  std::vector<Link> links;
  const auto add = [&](const Json& text) {
    if (!text.is_string()) return;
    if (auto link = link_from_text(text.string())) {
      link->place = text.place;
      links.push_back(std::move(*link));
    }
  };
  if (json.is_array())
    for (const Json& element : json.array()) add(element);
  else
    add(json);
  return links;
}

Inputs inputs_from_json(const Json& json) {
  return {links_from_json(json), json.is_array(), json.key_place};
}

template <class Map>
std::optional<Json> member(const Map& map, const std::string& key) {
  const auto found = map.find(key);
  if (found == map.end()) return {};
  return found->second;
}
template <class Map>
void set_member(Map& map, const std::string& key, std::optional<Json> value) {
  if (value)
    map[key] = std::move(*value);
  else
    map.erase(key);
}

}  // namespace

Json to_json(const Node& node) {
  if (node.missing) return *node.missing;
  Json::Object object;
  object["type"] = node.type;
  if (node.version != 1) object["version"] = node.version;
  if (!node.enabled) object["enabled"] = false;
  if (!node.note.empty()) object["note"] = node.note;
  if (!node.params.empty()) object["params"] = Json::Object(node.params.begin(), node.params.end());
  Json::Object inputs;
  for (const auto& [port, links] : node.inputs)
    if (!links.links.empty()) inputs[port] = links_to_json(links.links, links.list);
  if (!inputs.empty()) object["inputs"] = std::move(inputs);
  for (const auto& [key, value] : node.extras) object[key] = value;
  return object;
}

Node node_from_json(const Json& json) {
  Node node;
  node.place = json.key_place;
  if (const Json* type = json.find("type"); type && type->is_string()) node.type = type->string();
  if (const Json* version = json.find("version"); version && version->is_number())
    if (version->number() >= 1 && version->number() <= 1e9)
      node.version = static_cast<int>(version->number());
  if (const Json* enabled = json.find("enabled"); enabled && enabled->is_boolean())
    node.enabled = enabled->boolean();
  if (const Json* note = json.find("note"); note && note->is_string()) node.note = note->string();
  if (const Json* params = json.find("params"); params && params->is_object())
    node.params.insert(params->object().begin(), params->object().end());
  if (const Json* inputs = json.find("inputs"); inputs && inputs->is_object())
    for (const auto& [port, links] : inputs->object())
      if (Inputs read = inputs_from_json(links); !read.links.empty()) node.inputs[port] = std::move(read);
  if (json.is_object())
    for (const auto& [key, value] : json.object())
      if (is_extra_key(key)) node.extras[key] = value;
  return node;
}

Node missing_node_from_json(Json json) {
  Node node = node_from_json(json);
  node.missing = std::move(json);
  return node;
}

std::string to_text(const Unit& unit) {
  switch (unit.kind) {
    case Unit::Kind::node:
    case Unit::Kind::missing_node:
      return unit.name;
    case Unit::Kind::node_type:
      return unit.name + ": type";
    case Unit::Kind::node_enabled:
      return unit.name + ": enabled";
    case Unit::Kind::node_note:
      return unit.name + ": note";
    case Unit::Kind::node_param:
    case Unit::Kind::node_input:
      return unit.name + "." + unit.key;
    case Unit::Kind::node_extra:
      return unit.name + ": " + unit.key;
    case Unit::Kind::variable:
      return "variables." + unit.name;
    case Unit::Kind::publish_param:
      return "publish.params." + unit.name;
    case Unit::Kind::publish_input:
      return "publish.inputs." + unit.name;
    case Unit::Kind::publish_output:
      return "publish.outputs." + unit.name;
    case Unit::Kind::publish_extra:
      return "publish." + unit.name;
    case Unit::Kind::ui_node:
      return "ui.nodes." + unit.name;
    case Unit::Kind::ui_frame:
      return "ui.frames." + unit.name;
    case Unit::Kind::ui_note:
      return "ui.notes." + unit.name;
    case Unit::Kind::ui_extra:
      return "ui." + unit.name;
    case Unit::Kind::extra:
      return unit.name;
  }
  return "";
}

namespace {

using Targets = std::map<std::string, std::vector<Link>, std::less<>>;

std::optional<Json> get_targets(const Targets& targets, const std::string& name) {
  const auto found = targets.find(name);
  if (found == targets.end()) return {};
  return links_to_json(found->second, found->second.size() != 1);
}
void set_targets(Targets& targets, const std::string& name, const std::optional<Json>& value) {
  if (value)
    targets[name] = links_from_json(*value);
  else
    targets.erase(name);
}

// The part of a node's object that a unit stands for: the object that holds it, and the key there.
struct Part {
  const char* object;  // "" = the node's own
  std::string key;
};
Part part_of(const Unit& unit) {
  switch (unit.kind) {
    case Unit::Kind::node_enabled:
      return {"", "enabled"};
    case Unit::Kind::node_note:
      return {"", "note"};
    case Unit::Kind::node_param:
      return {"params", unit.key};
    case Unit::Kind::node_input:
      return {"inputs", unit.key};
    default:
      return {"", unit.key};
  }
}

std::optional<Json> type_and_version(const Node& node) {
  return Json(Json::Object{{"type", node.type}, {"version", node.version}});
}

std::optional<Json> get_of_missing(const Node& node, const Unit& unit) {
  if (unit.kind == Unit::Kind::node_type) return type_and_version(node);
  const Part part = part_of(unit);
  const Json* object = *part.object ? node.missing->find(part.object) : &*node.missing;
  const Json* value = object ? object->find(part.key) : nullptr;
  if (!value) return {};
  return *value;
}

Node with_part_of_missing(const Node& node, const Unit& unit, std::optional<Json> value) {
  Json whole = *node.missing;
  if (unit.kind == Unit::Kind::node_type) {
    whole.object()["type"] = value ? *value->find("type") : Json("");
    const Json* version = value ? value->find("version") : nullptr;
    const bool is_first = !version || *version == Json(1);
    set_member(whole.object(), "version", is_first ? std::nullopt : std::optional<Json>(*version));
    return missing_node_from_json(std::move(whole));
  }
  const Part part = part_of(unit);
  if (!*part.object) {
    set_member(whole.object(), part.key, std::move(value));
  } else {
    Json& object = whole.object()[part.object];
    if (!object.is_object()) object = Json(Json::Object{});
    set_member(object.object(), part.key, std::move(value));
    if (object.object().empty()) whole.object().erase(part.object);
  }
  return missing_node_from_json(std::move(whole));
}

std::optional<Json> get_of_node(const Node& node, const Unit& unit) {
  if (node.missing) return get_of_missing(node, unit);
  switch (unit.kind) {
    case Unit::Kind::node_type:
      return type_and_version(node);
    case Unit::Kind::node_enabled:
      return node.enabled ? std::nullopt : std::optional<Json>(false);
    case Unit::Kind::node_note:
      return node.note.empty() ? std::nullopt : std::optional<Json>(node.note);
    case Unit::Kind::node_param:
      return member(node.params, unit.key);
    case Unit::Kind::node_input: {
      const auto found = node.inputs.find(unit.key);
      if (found == node.inputs.end() || found->second.links.empty()) return {};
      return links_to_json(found->second.links, found->second.list);
    }
    default:
      return member(node.extras, unit.key);
  }
}

void set_of_node(Node& node, const Unit& unit, std::optional<Json> value) {
  if (node.missing) {
    const Place place = node.place;
    node = with_part_of_missing(node, unit, std::move(value));
    node.place = place;
    return;
  }
  switch (unit.kind) {
    case Unit::Kind::node_type:
      node.type = value ? value->find("type")->string() : std::string();
      node.version = value ? static_cast<int>(value->find("version")->number()) : 1;
      return;
    case Unit::Kind::node_enabled:
      node.enabled = !value || value->boolean();
      return;
    case Unit::Kind::node_note:
      node.note = value ? value->string() : std::string();
      return;
    case Unit::Kind::node_param:
      return set_member(node.params, unit.key, std::move(value));
    case Unit::Kind::node_input:
      if (value)
        node.inputs[unit.key] = inputs_from_json(*value);
      else
        node.inputs.erase(unit.key);
      return;
    default:
      return set_member(node.extras, unit.key, std::move(value));
  }
}

void set_whole_node(Document& document, const Unit& unit, std::optional<Json> value) {
  if (!value) {
    document.nodes.erase(unit.name);
    return;
  }
  document.nodes[unit.name] = unit.kind == Unit::Kind::missing_node
                                  ? missing_node_from_json(std::move(*value))
                                  : node_from_json(*value);
}

}  // namespace

std::optional<Json> get(const Document& document, const Unit& unit) {
  switch (unit.kind) {
    case Unit::Kind::variable:
      return member(document.variables, unit.name);
    case Unit::Kind::publish_param:
      return get_targets(document.publish.params, unit.name);
    case Unit::Kind::publish_input:
      return get_targets(document.publish.inputs, unit.name);
    case Unit::Kind::publish_output:
      return get_targets(document.publish.outputs, unit.name);
    case Unit::Kind::publish_extra:
      return member(document.publish.extras, unit.name);
    case Unit::Kind::ui_node:
      return member(document.ui.nodes, unit.name);
    case Unit::Kind::ui_frame:
      return member(document.ui.frames, unit.name);
    case Unit::Kind::ui_note:
      return member(document.ui.notes, unit.name);
    case Unit::Kind::ui_extra:
      return member(document.ui.extras, unit.name);
    case Unit::Kind::extra:
      return member(document.extras, unit.name);
    default:
      break;
  }
  const auto node = document.nodes.find(unit.name);
  if (node == document.nodes.end()) return {};
  if (unit.kind == Unit::Kind::node || unit.kind == Unit::Kind::missing_node) {
    if (node->second.missing.has_value() != (unit.kind == Unit::Kind::missing_node)) return {};
    return to_json(node->second);
  }
  return get_of_node(node->second, unit);
}

void set(Document& document, const Unit& unit, std::optional<Json> value) {
  switch (unit.kind) {
    case Unit::Kind::variable:
      return set_member(document.variables, unit.name, std::move(value));
    case Unit::Kind::publish_param:
      return set_targets(document.publish.params, unit.name, value);
    case Unit::Kind::publish_input:
      return set_targets(document.publish.inputs, unit.name, value);
    case Unit::Kind::publish_output:
      return set_targets(document.publish.outputs, unit.name, value);
    case Unit::Kind::publish_extra:
      return set_member(document.publish.extras, unit.name, std::move(value));
    case Unit::Kind::ui_node:
      return set_member(document.ui.nodes, unit.name, std::move(value));
    case Unit::Kind::ui_frame:
      return set_member(document.ui.frames, unit.name, std::move(value));
    case Unit::Kind::ui_note:
      return set_member(document.ui.notes, unit.name, std::move(value));
    case Unit::Kind::ui_extra:
      return set_member(document.ui.extras, unit.name, std::move(value));
    case Unit::Kind::extra:
      return set_member(document.extras, unit.name, std::move(value));
    case Unit::Kind::node:
    case Unit::Kind::missing_node:
      return set_whole_node(document, unit, std::move(value));
    default:
      break;
  }
  const auto node = document.nodes.find(unit.name);
  if (node == document.nodes.end())
    throw std::logic_error("there is no node \"" + unit.name + "\" to change");
  set_of_node(node->second, unit, std::move(value));
}

}  // namespace kinegraph
