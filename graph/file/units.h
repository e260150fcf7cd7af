// The units of which a document is made up, listed: what diff and merge walk through.
#pragma once
#include <string>
#include <vector>

#include "graph/document.h"

namespace kinegraph {

// The parts of a node, in the file's order: type, enabled, note, params, inputs, extras. Of a missing node
// those of the object it is kept as. Nothing where there is no such node.
std::vector<Unit> units_of_node(const Document& document, const std::string& name);
// What belongs to no node and means something: variables, publish, extras. No ui.
std::vector<Unit> units_of_file(const Document& document);
std::vector<Unit> units_of_ui(const Document& document);

}  // namespace kinegraph
