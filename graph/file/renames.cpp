#include "graph/file/renames.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace kinegraph {

namespace {

// What a node is known by: its parameters and links, and who links to it, each as one text.
using Values = std::set<std::string>;
using Consumers = std::map<std::string, std::vector<std::string>, std::less<>>;  // node -> "port>node.port"

const std::string& now(const std::string& name, const Renames& known) {
  const auto found = known.find(name);
  return found == known.end() ? name : found->second;
}

using Names = std::set<std::string_view>;

Names only_in(const Document& document, const Document& other) {
  Names names;
  auto there = other.nodes.begin();
  for (const auto& [name, node] : document.nodes) {
    while (there != other.nodes.end() && there->first < name) ++there;
    if (there == other.nodes.end() || there->first != name) names.insert(name);
  }
  return names;
}

// Of these nodes, with the names that nodes have after the renames that are known.
Consumers consumers_of(const Names& names, const Document& document, const Renames& known) {
  Consumers all;
  for (const auto& [name, node] : document.nodes)
    for (const auto& [port, inputs] : node.inputs)
      for (const Link& link : inputs.links)
        if (names.contains(link.node))
          all[link.node].push_back(link.port + ">" + now(name, known) + "." + port);
  return all;
}

Values values_of(const std::string& name, const Node& node, const Consumers& consumers,
                 const Renames& known) {
  Values values;
  for (const auto& [param, value] : node.params) values.insert("p" + param + "=" + compact(value));
  for (const auto& [port, inputs] : node.inputs)
    for (const Link& link : inputs.links)
      values.insert("i" + port + "<" + now(link.node, known) + "." + link.port);
  if (const auto found = consumers.find(name); found != consumers.end())
    for (const std::string& consumer : found->second) values.insert("c" + consumer);
  return values;
}

struct Pair {
  double likeness;
  std::string before, after;
};

std::vector<Pair> pairs(const Document& before, const Document& after, const Renames& known) {
  std::set<std::string, std::less<>> taken;
  for (const auto& [from, to] : known) taken.insert(to);
  struct Fresh {
    const std::string* name;
    const std::string* type;
    std::size_t values;
  };
  std::vector<Fresh> fresh;
  std::map<std::string, std::vector<std::size_t>> with_value;  // which of the new nodes have it
  const Names gone = only_in(before, after), added = only_in(after, before);
  if (gone.empty() || added.empty()) return {};
  const Consumers consumers_before = consumers_of(gone, before, known),
                  consumers_after = consumers_of(added, after, {});
  for (const std::string_view name_of_one : added) {
    const auto& [name, node] = *after.nodes.find(name_of_one);
    if (taken.contains(name)) continue;
    const Values values = values_of(name, node, consumers_after, {});
    for (const std::string& value : values) with_value[value].push_back(fresh.size());
    fresh.push_back({&name, &node.type, values.size()});
  }
  std::vector<Pair> found;
  std::vector<std::size_t> kept(fresh.size());
  for (const std::string_view name_of_one : gone) {
    const auto& [name, node] = *before.nodes.find(name_of_one);
    if (known.contains(name) || fresh.empty()) continue;
    std::fill(kept.begin(), kept.end(), 0);
    const Values values = values_of(name, node, consumers_before, known);
    for (const std::string& value : values)
      if (const auto there = with_value.find(value); there != with_value.end())
        for (const std::size_t i : there->second) ++kept[i];
    for (std::size_t i = 0; i < fresh.size(); ++i)
      if (kept[i] > 0 && 2 * kept[i] >= values.size() && *fresh[i].type == node.type)
        found.push_back(
            {static_cast<double>(kept[i]) / static_cast<double>(std::max(values.size(), fresh[i].values)),
             name, *fresh[i].name});
  }
  std::sort(found.begin(), found.end(), [](const Pair& a, const Pair& b) {
    return std::tuple(-a.likeness, a.before, a.after) < std::tuple(-b.likeness, b.before, b.after);
  });
  return found;
}

Link renamed(const Link& link, const Renames& names) {
  return {now(link.node, names), link.port, link.place};
}

// All are taken out before any goes back, so that names may be exchanged.
template <typename Map>
void rename_keys(Map& map, const Renames& names) {
  std::vector<typename Map::node_type> taken;
  for (const auto& [from, to] : names)
    if (auto entry = map.extract(from)) {
      entry.key() = to;
      taken.push_back(std::move(entry));
    }
  for (auto& entry : taken) map.insert(std::move(entry));
}

Json renamed_in_missing(Json whole, const Renames& names) {
  if (!whole.is_object() || !whole.find("inputs") || !whole.find("inputs")->is_object()) return whole;
  const auto change = [&](Json& text) {
    if (!text.is_string()) return;
    if (const auto link = link_from_text(text.string())) text = Json(to_text(renamed(*link, names)));
  };
  for (auto& [port, links] : whole.object()["inputs"].object()) {
    if (links.is_array())
      for (Json& link : links.array()) change(link);
    else
      change(links);
  }
  return whole;
}

}  // namespace

Renames renames(const Document& before, const Document& after) {
  // Each round knows the names of the round before, so that a chain of renamed nodes is found link by link.
  Renames known;
  for (bool more = true; more;) {
    more = false;
    std::set<std::string> taken;
    for (const auto& pair : pairs(before, after, known)) {
      if (known.contains(pair.before) || !taken.insert(pair.after).second) continue;
      known[pair.before] = pair.after;
      more = true;
    }
  }
  return known;
}

Document renamed(Document document, const Renames& names) {
  if (names.empty()) return document;
  Document result = std::move(document);
  for (auto& [name, node] : result.nodes) {
    for (auto& [port, inputs] : node.inputs)
      for (Link& link : inputs.links)
        if (names.contains(link.node)) link = renamed(link, names);
    if (node.missing) node.missing = renamed_in_missing(std::move(*node.missing), names);
  }
  rename_keys(result.nodes, names);
  for (auto* published : {&result.publish.params, &result.publish.inputs, &result.publish.outputs})
    for (auto& [name, links] : *published)
      for (Link& link : links) link = renamed(link, names);
  rename_keys(result.ui.nodes, names);
  for (auto& [name, frame] : result.ui.frames) {
    const Json* nodes = frame.find("nodes");
    if (!nodes || !nodes->is_array()) continue;
    for (Json& member : frame.object()["nodes"].array())
      if (member.is_string()) member = Json(now(member.string(), names));
  }
  return result;
}

}  // namespace kinegraph
