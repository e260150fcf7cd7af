// Which outputs of a graph show a node: itself where it makes a motion, else what leads to it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "graph/document.h"
#include "graph/evaluate/run_log.h"
#include "graph/registry.h"

namespace kinegraph {

// The type of what comes out of an output, "" where that isn't known; through Switch and Dot that of what
// they pass on.
std::string type_of_output(const Document& document, const Registry& registry, const Target& target);

// The nearest output of one of `types`: the node's own, else, against the links, that of what leads to it,
// breadth first in the order of its ports.
std::optional<Target> nearest_output(const Document& document, const Registry& registry,
                                     const std::string& node, const std::vector<std::string>& types);
// All outputs of a node of a type, in the order of its ports.
std::vector<Target> outputs_of(const Document& document, const Registry& registry, const std::string& node,
                               const std::string& type);
// What is linked to an input, first link first.
std::vector<Target> linked_to(const Document& document, const std::string& node, const std::string& port);
// A node to look at when nobody chose one: the last by links that makes a motion, first by name.
std::string node_to_look_at(const Document& document, const Registry& registry);

}  // namespace kinegraph
