#include "gui/evaluation/described.h"

#include <set>

namespace kinegraph {

namespace {

void describe(const Document& document, const std::string& name, std::set<std::string>& seen,
              std::string& text) {
  const auto node = document.nodes.find(name);
  if (node == document.nodes.end() || !seen.insert(name).second) return;
  text += name + compact(to_json(node->second));
  for (const auto& [port, inputs] : node->second.inputs)
    for (const Link& link : inputs.links) describe(document, link.node, seen, text);
}

}  // namespace

std::string described(const Document& document, const std::string& node) {
  std::set<std::string> seen;
  std::string text;
  describe(document, node, seen, text);
  for (const auto& [variable, value] : document.variables) text += variable + compact(value);
  return text;
}

}  // namespace kinegraph
