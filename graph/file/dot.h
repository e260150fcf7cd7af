// A graph as Graphviz text, to look at outside the editor.
#pragma once
#include <string>

#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

// Left to right: inputs on a node's left side, outputs on its right; frames are clusters; disabled nodes are dashed,
// missing ones dashed and red. Sorted by name: the same document gives the same text.
std::string dot_text(const Document& document, const Registry& registry);

}  // namespace kinegraph
