// The canonical form of a graph file; see the contract's "Graph file".
#pragma once
#include <string>

#include "graph/document.h"
#include "graph/file/write_atomically.h"
#include "graph/registry.h"

namespace kinegraph {

// Load-save is the identity on canonical files whose nodes are current. Parameters equal to their default are left out.
std::string write_document(const Document& document, const Registry& registry);

}  // namespace kinegraph
