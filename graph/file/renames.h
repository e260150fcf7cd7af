// Nodes that two states of a graph have under different names.
#pragma once
#include <map>
#include <string>

#include "graph/document.h"

namespace kinegraph {

using Renames = std::map<std::string, std::string, std::less<>>;  // name before -> name after

// A node that is gone and one that is new are one node renamed when they have one type and at least half of
// the old one's values (parameters and links, and what links to it) are the new one's too. The likest are
// paired first; equal ones in the order of their names.
Renames renames(const Document& before, const Document& after);

// The document with all of them made at once: links, publish and ui follow. The new names are free, or of
// nodes that are renamed themselves.
Document renamed(Document document, const Renames& names);

}  // namespace kinegraph
