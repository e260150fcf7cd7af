#include "gui/viewing/looked_at.h"

#include <algorithm>
#include <cctype>
#include <deque>
#include <initializer_list>
#include <set>
#include <string_view>

#include "graph/nested.h"

namespace kinegraph {
namespace {

// Ports in the order of the type's description, then those that only the file knows (of a nested graph).
std::vector<Target> links_into(const Document& document, const Registry& registry, const std::string& name) {
  std::vector<Target> all;
  auto found = document.nodes.find(name);
  if (found == document.nodes.end()) return all;
  const Node& node = found->second;
  std::set<std::string> seen;
  const auto take = [&](const std::string& port) {
    auto inputs = node.inputs.find(port);
    if (inputs == node.inputs.end() || !seen.insert(port).second) return;
    for (const Link& link : inputs->second.links) all.push_back({link.node, link.port});
  };
  if (const NodeType* type = known_type(registry, node))
    for (const InputPort& port : type->inputs) take(port.name);
  for (const auto& [port, inputs] : node.inputs) take(port);
  return all;
}

// A Load has a port for everything that files can hold; what its file's ending speaks against isn't asked
// for, as that would be an error of the node.
bool may_make(const Node& node, const std::string& type) {
  if (node.type != "Load") return true;
  auto file = node.params.find("file");
  if (file == node.params.end() || !file->second.is_string()) return true;
  std::string path = file->second.string();
  std::transform(path.begin(), path.end(), path.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto ends = [&](std::initializer_list<std::string_view> endings) {
    return std::any_of(endings.begin(), endings.end(), [&](std::string_view e) { return path.ends_with(e); });
  };
  if (ends({".bvh", ".amc", ".asf"})) return type == "Motion";
  if (ends({".c3d", ".trc", ".csv"})) return type == "Points" || (path.ends_with(".csv") && type != "Motion");
  if (ends({".glb", ".gltf"})) return type == "Motion" || type == "Character";
  if (ends({".json"})) return type != "Motion" && type != "Points" && type != "Character";
  return true;
}

std::string type_of(const Document& document, const Registry& registry, const Target& target, int depth) {
  auto node = document.nodes.find(target.node);
  if (node == document.nodes.end() || depth > 64) return {};
  const NodeType* type = known_type(registry, node->second);
  const OutputPort* port = type ? type->find_output(target.port) : nullptr;
  if (!port) return {};
  if (!port->type.empty()) return port->type;
  for (const Target& source : links_into(document, registry, target.node)) {
    std::string passed = type_of(document, registry, source, depth + 1);
    if (!passed.empty()) return passed;
  }
  return {};
}

// Of what nearby nodes before it make; first in the list where none of them makes any.
std::string type_fed_with(const Document& document, const Registry& registry, const std::string& node,
                          const std::vector<std::string>& types) {
  std::deque<std::string> waiting{node};
  std::set<std::string> seen{node};
  while (!waiting.empty()) {
    const std::string at = waiting.front();
    waiting.pop_front();
    for (const Target& source : links_into(document, registry, at)) {
      const std::string type = type_of(document, registry, source, 0);
      if (std::find(types.begin(), types.end(), type) != types.end()) return type;
      if (seen.insert(source.node).second) waiting.push_back(source.node);
    }
  }
  return types.front();
}

}  // namespace

std::string type_of_output(const Document& document, const Registry& registry, const Target& target) {
  return type_of(document, registry, target, 0);
}

std::vector<Target> outputs_of(const Document& document, const Registry& registry, const std::string& node,
                               const std::string& type) {
  std::vector<Target> all;
  auto found = document.nodes.find(node);
  if (found == document.nodes.end() || !may_make(found->second, type)) return all;
  if (const NodeType* node_type = known_type(registry, found->second))
    for (const OutputPort& port : node_type->outputs)
      if (type_of_output(document, registry, {node, port.name}) == type) all.push_back({node, port.name});
  return all;
}

std::optional<Target> nearest_output(const Document& document, const Registry& registry,
                                     const std::string& node, const std::vector<std::string>& types) {
  std::deque<std::string> waiting{node};
  std::set<std::string> seen{node};
  while (!waiting.empty()) {
    const std::string at = waiting.front();
    waiting.pop_front();
    // What can make motions or points makes what it is fed with.
    std::vector<std::vector<Target>> own;
    std::vector<std::string> made;
    for (const std::string& type : types)
      if (std::vector<Target> some = outputs_of(document, registry, at, type); !some.empty()) {
        own.push_back(std::move(some));
        made.push_back(type);
      }
    if (own.size() == 1) return own.front().front();
    if (!own.empty()) {
      const std::string fed = type_fed_with(document, registry, at, made);
      return own[static_cast<std::size_t>(std::find(made.begin(), made.end(), fed) - made.begin())].front();
    }
    for (const Target& source : links_into(document, registry, at)) {
      // The very output that is linked comes first: a node may make several motions.
      const std::string type = type_of_output(document, registry, source);
      if (std::find(types.begin(), types.end(), type) != types.end()) return source;
      if (seen.insert(source.node).second) waiting.push_back(source.node);
    }
  }
  return {};
}

std::vector<Target> linked_to(const Document& document, const std::string& node, const std::string& port) {
  std::vector<Target> all;
  auto found = document.nodes.find(node);
  if (found == document.nodes.end()) return all;
  auto inputs = found->second.inputs.find(port);
  if (inputs != found->second.inputs.end())
    for (const Link& link : inputs->second.links) all.push_back({link.node, link.port});
  return all;
}

std::string node_to_look_at(const Document& document, const Registry& registry) {
  std::set<std::string> consumed;  // by nodes that themselves make a motion
  const auto shows = [&](const std::string& name) {
    return !outputs_of(document, registry, name, "Motion").empty() ||
           !outputs_of(document, registry, name, "Points").empty();
  };
  std::vector<std::string> showing;
  for (const auto& [name, node] : document.nodes) {
    if (!shows(name)) continue;
    showing.push_back(name);
    for (const Target& source : links_into(document, registry, name)) consumed.insert(source.node);
  }
  for (const std::string& name : showing)
    if (!consumed.count(name)) return name;
  return showing.empty() ? std::string() : showing.front();
}

}  // namespace kinegraph
