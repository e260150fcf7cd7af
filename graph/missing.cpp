#include "graph/missing.h"

#include <fmt/format.h>

namespace kinegraph {

Diagnostic unknown_type(const Registry& registry, const std::string& type) {
  const std::string near = nearest(type, registry.names());
  return warning("unknown-type", fmt::format("there is no node type {}", in_quotes(type)))
      .hinting(near.empty() ? "the node is kept as it stands and can't run"
                            : fmt::format("did you mean \"{}\"?", near));
}

Diagnostic newer_version(const NodeType& type, int version) {
  return warning("newer-version",
                 fmt::format("{} of version {}, this program knows {}", type.name, version, type.version))
      .hinting("the node is kept as it stands and can't run; a newer Kinegraph knows it");
}

std::optional<Diagnostic> why_missing(const Registry& registry, const Node& node) {
  if (!node.missing || node.older) return {};
  const NodeType* type = registry.find(node.type);
  if (!type) return unknown_type(registry, node.type);
  const Json* version = node.missing->find("version");
  if (version && version->is_number() && version->number() > type->version)
    return newer_version(*type, static_cast<int>(version->number()));
  return {};
}

}  // namespace kinegraph
