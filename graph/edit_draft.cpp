#include "graph/edit_draft.h"

#include <fmt/format.h>

#include <algorithm>

#include "graph/nested.h"

namespace kinegraph {

void EditDraft::set(const Unit& unit, std::optional<Json> after) {
  std::optional<Json> before = get(document_, unit);
  if (before == after) return;
  kinegraph::set(document_, unit, after);
  edit_.changes.push_back({unit, std::move(before), std::move(after)});
}

void EditDraft::add_node(const std::string& name, const Node& node) {
  set({node.missing ? Unit::Kind::missing_node : Unit::Kind::node, name, {}}, to_json(node));
}

void EditDraft::remove_node(const std::string& name) {
  const bool missing = document_.nodes.at(name).missing.has_value();
  set({missing ? Unit::Kind::missing_node : Unit::Kind::node, name, {}}, std::nullopt);
}

void EditDraft::change_links(const std::string& node, const std::string& port,
                             const std::function<std::optional<Link>(const Link&)>& change) {
  const Unit unit{Unit::Kind::node_input, node, port};
  const auto before = get(document_, unit);
  if (!before) return;
  const auto changed = [&](const Json& text) -> std::optional<Json> {
    const auto link = text.is_string() ? link_from_text(text.string()) : std::nullopt;
    if (!link) return text;
    const auto instead = change(*link);
    if (!instead) return {};
    return Json(to_text(*instead));
  };
  if (!before->is_array()) return set(unit, changed(*before));
  Json::Array after;
  for (const Json& element : before->array())
    if (auto instead = changed(element)) after.push_back(std::move(*instead));
  if (after.empty())
    set(unit, std::nullopt);
  else
    set(unit, Json(std::move(after)));
}

void EditDraft::change_links(
    const std::function<std::optional<Link>(const std::string&, const std::string&, const Link&)>& change) {
  std::vector<std::pair<std::string, std::string>> ports;
  for (const auto& [name, node] : document_.nodes)
    for (const auto& [port, inputs] : node.inputs) ports.emplace_back(name, port);
  for (const auto& [name, port] : ports)
    change_links(name, port, [&](const Link& link) { return change(name, port, link); });
}

void EditDraft::change_published(const std::function<std::optional<Link>(Unit::Kind, const Link&)>& change) {
  const Publish publish = document_.publish;
  const auto change_all = [&](Unit::Kind kind, const auto& targets) {
    for (const auto& [name, links] : targets) {
      Json::Array after;
      for (const Link& link : links)
        if (const auto instead = change(kind, link)) after.push_back(to_text(*instead));
      const Unit unit{kind, name, {}};
      if (after.empty())
        set(unit, std::nullopt);
      else if (after.size() == 1)
        set(unit, after.front());
      else
        set(unit, Json(std::move(after)));
    }
  };
  change_all(Unit::Kind::publish_param, publish.params);
  change_all(Unit::Kind::publish_input, publish.inputs);
  change_all(Unit::Kind::publish_output, publish.outputs);
}

void EditDraft::change_in_ui(const std::string& name, const std::optional<std::string>& instead) {
  if (const auto entry = get(document_, {Unit::Kind::ui_node, name, {}})) {
    set({Unit::Kind::ui_node, name, {}}, std::nullopt);
    if (instead) set({Unit::Kind::ui_node, *instead, {}}, entry);
  }
  const auto frames = document_.ui.frames;
  for (const auto& [title, frame] : frames) {
    const Json* nodes = frame.find("nodes");
    if (!nodes || !nodes->is_array()) continue;
    if (std::find(nodes->array().begin(), nodes->array().end(), Json(name)) == nodes->array().end()) continue;
    Json::Array names;
    for (const Json& element : nodes->array()) {
      if (!(element == Json(name)))
        names.push_back(element);
      else if (instead)
        names.push_back(*instead);
    }
    // A frame goes with the last of its nodes: around nothing nobody could see it any more.
    std::optional<Json> after;
    if (!names.empty()) {
      after = frame;
      after->object()["nodes"] = std::move(names);
    }
    set({Unit::Kind::ui_frame, title, {}}, std::move(after));
  }
}

const Node& node_or_fail(const Document& document, const std::string& name) {
  if (const auto node = document.nodes.find(name); node != document.nodes.end()) return node->second;
  std::vector<std::string> names;
  for (const auto& [other, node] : document.nodes) names.push_back(other);
  throw Failure(
      error("unknown-node", fmt::format("there is no node \"{}\"", name)).hinting(suggestion(name, names)));
}

const NodeType& type_or_fail(const Document& document, const Registry& registry, const std::string& name) {
  const Node& node = node_or_fail(document, name);
  const NodeType* type = known_type(registry, node);
  if (!type)
    throw Failure(error("missing-node", fmt::format("{} is missing and kept as it stands", name))
                      .at_node(name)
                      .hinting(fmt::format("a program that knows {} can change it", node.type)));
  return *type;
}

std::optional<Link> link_past(const Document& document, const Registry& registry, const Link& link,
                              const std::function<bool(const std::string&)>& is_gone) {
  Link at = link;
  // A chain of nodes that are gone is no longer than the document; more steps go round in a circle.
  for (std::size_t step = 0; step <= document.nodes.size() && is_gone(at.node); ++step) {
    const auto node = document.nodes.find(at.node);
    if (node == document.nodes.end() || node->second.missing) return {};
    const NodeType* type = known_type(registry, node->second);
    const OutputPort* output = type ? type->find_output(at.port) : nullptr;
    if (!output || output->passes.empty()) return {};
    const auto inputs = node->second.inputs.find(output->passes);
    if (inputs == node->second.inputs.end() || inputs->second.links.empty()) return {};
    at = inputs->second.links.front();
  }
  if (is_gone(at.node)) return {};
  return at;
}

}  // namespace kinegraph
