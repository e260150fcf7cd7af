// The node reference, made from the registry's descriptions alone: as text for a terminal, as markdown, as JSON.
#pragma once
#include <string>

#include "graph/registry.h"

namespace kinegraph {

// All types, a line each, under their families.
std::string reference_list(const Registry& registry);
// One type: what it does, ports, parameters, source.
std::string reference_text(const NodeType& type);
std::string reference_markdown(const NodeType& type);
// All types, with a table of contents and the port types.
std::string reference_markdown(const Registry& registry);
// {"name", "category", "help", "source", "keywords", "version", "code_version", "effect", "inputs": [{"name", "types",
// "help", "optional", "list"}], "outputs": [{"name", "type", "help", "disabled"}], "params": [{"name", "kind", "help",
// "default", "min", "max", "soft_min", "soft_max", "unit", "choices", "parts"}]}; what is empty is left out.
Json reference_json(const NodeType& type);
// {"format": "kinegraph-reference", "schema": 1, "port_types": {…}, "nodes": {NAME: …}}
Json reference_json(const Registry& registry);

}  // namespace kinegraph
