// Copying a part of a graph, and pasting it with fresh names.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "graph/edit.h"
#include "graph/edit_draft.h"
#include "graph/links.h"
#include "graph/nested.h"
#include "graph/variables.h"

namespace kinegraph {

namespace {

std::string with_random_end(std::string start, const std::function<bool(const std::string&)>& is_taken) {
  static constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device device;
  std::uniform_int_distribution<std::size_t> letter(0, letters.size() - 1);
  for (char& c : start) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  start.resize(std::min<std::size_t>(start.size(), 59));
  for (;;) {
    std::string name = start + "_";
    for (int i = 0; i < 4; ++i) name += letters[letter(device)];
    if (!is_taken(name)) return name;
  }
}

Json moved(Json entry, int dx, int dy) {
  const Json* pos = entry.find("pos");
  if (!pos || !pos->is_array() || pos->array().size() != 2 || !pos->array()[0].is_number() ||
      !pos->array()[1].is_number())
    return entry;
  entry.object()["pos"] = Json::Array{pos->array()[0].number() + dx, pos->array()[1].number() + dy};
  return entry;
}

std::vector<std::string> nodes_of_frame(const Json& frame) {
  std::vector<std::string> names;
  if (const Json* nodes = frame.find("nodes"); nodes && nodes->is_array())
    for (const Json& name : nodes->array())
      if (name.is_string()) names.push_back(name.string());
  return names;
}

}  // namespace

std::string fresh_name(const Document& document, std::string_view type) {
  const bool good = is_node_name(type);
  return with_random_end(good ? std::string(type) : "node",
                         [&](const std::string& name) { return document.nodes.count(name) > 0; });
}

Document copied(const Document& document, const Registry& registry, const std::vector<std::string>& names) {
  Document part;
  const std::set<std::string> chosen(names.begin(), names.end());
  for (const std::string& name : chosen) {
    const Node& node = node_or_fail(document, name);
    part.nodes[name] = node;
    if (const auto entry = document.ui.nodes.find(name); entry != document.ui.nodes.end())
      part.ui.nodes.insert(*entry);
    const NodeType* type = known_type(registry, node);
    for (const auto& [key, value] : node.params)
      if (const Param* param = type ? type->find_param(key) : nullptr)
        for (const std::string& variable : variables_in(value, *param))
          if (const auto found = document.variables.find(variable); found != document.variables.end())
            part.variables.insert(*found);
  }
  for (const auto& [title, frame] : document.ui.frames) {
    const auto inside = nodes_of_frame(frame);
    if (!inside.empty() &&
        std::all_of(inside.begin(), inside.end(), [&](const auto& n) { return chosen.count(n); }))
      part.ui.frames[title] = frame;
  }
  return part;
}

Edit paste(const Document& document, const Registry& registry, const Document& part, int dx, int dy,
           std::vector<std::string>* names) {
  EditDraft draft(document,
                  part.nodes.size() == 1 ? "Paste a node" : fmt::format("Paste {} nodes", part.nodes.size()));
  for (const auto& [name, value] : part.variables)
    if (!document.variables.count(name)) draft.set({Unit::Kind::variable, name, {}}, value);

  std::map<std::string, std::string> new_names;
  for (const auto& [name, node] : part.nodes) {
    const std::string fresh = fresh_name(draft.document(), node.type);
    new_names[name] = fresh;
    if (names) names->push_back(fresh);
    Node alone = node;
    if (!node.missing) alone.inputs.clear();  // they follow once all the nodes are there
    draft.add_node(fresh, alone);
  }
  for (const auto& [name, node] : part.nodes) {
    const std::string& fresh = new_names.at(name);
    for (const auto& [port, inputs] : node.inputs) {
      const auto rewired = [&, &to = port](const Link& link) -> std::optional<Link> {
        if (const auto inside = new_names.find(link.node); inside != new_names.end())
          return Link{inside->second, link.port, {}};
        if (!document.nodes.count(link.node)) return {};
        if (!node.missing && objection_to_link(draft.document(), registry, link, fresh, to)) return {};
        return link;
      };
      if (node.missing) {
        draft.change_links(fresh, port, rewired);
        continue;
      }
      Json::Array links;
      for (const Link& link : inputs.links)
        if (const auto kept = rewired(link)) links.push_back(to_text(*kept));
      if (links.empty()) continue;
      draft.set({Unit::Kind::node_input, fresh, port}, inputs.list ? Json(std::move(links)) : links.front());
    }
  }

  for (const auto& [name, entry] : part.ui.nodes)
    if (const auto fresh = new_names.find(name); fresh != new_names.end())
      draft.set({Unit::Kind::ui_node, fresh->second, {}}, moved(entry, dx, dy));
  for (const auto& [title, frame] : part.ui.frames) {
    Json::Array inside;
    for (const std::string& name : nodes_of_frame(frame))
      if (const auto fresh = new_names.find(name); fresh != new_names.end()) inside.push_back(fresh->second);
    Json entry = frame;
    entry.object()["nodes"] = std::move(inside);
    const auto is_taken = [&](const std::string& name) { return draft.document().ui.frames.count(name) > 0; };
    draft.set({Unit::Kind::ui_frame, with_random_end("frame", is_taken), {}}, std::move(entry));
  }
  for (const auto& [title, note] : part.ui.notes) {
    const auto is_taken = [&](const std::string& name) { return draft.document().ui.notes.count(name) > 0; };
    draft.set({Unit::Kind::ui_note, with_random_end("note", is_taken), {}}, moved(note, dx, dy));
  }
  return draft.take();
}

}  // namespace kinegraph
