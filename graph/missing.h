// Nodes that this program can't run and keeps as they stand: of a type it doesn't know, or of a newer
// version.
#pragma once
#include <optional>
#include <string>

#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

Diagnostic unknown_type(const Registry& registry, const std::string& type);  // a warning, "unknown-type"
Diagnostic newer_version(const NodeType& type, int version);                 // a warning, "newer-version"

// What is to be said of a node that is kept as it stands; nothing of one that is known. Without node and
// place.
std::optional<Diagnostic> why_missing(const Registry& registry, const Node& node);

}  // namespace kinegraph
