// What a node's result depends on in a document, as text: to tell whether a node that failed has changed
// since.
#pragma once
#include <string>

#include "graph/document.h"

namespace kinegraph {

// The node and all before it, and the document's variables.
std::string described(const Document& document, const std::string& node);

}  // namespace kinegraph
