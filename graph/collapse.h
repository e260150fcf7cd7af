// Nodes of a graph made into a graph file of their own, with one Graph node in their place: what the rest of
// the graph linked to them is published, and no key of any node changes.
#pragma once
#include <string>
#include <vector>

#include "graph/document.h"
#include "graph/edit.h"
#include "graph/registry.h"

namespace kinegraph {

struct CollapseOptions {
  std::string file;          // of the new graph, as the document will write it
  std::string folder;        // absolute, of the document: its relative paths start here
  std::string inner_folder;  // absolute, of the new file
};

struct Collapsed {
  Document inside;   // for the new file
  std::string node;  // the Graph node's name
  Edit edit;         // puts it in the nodes' place
};

// Graph nodes among the document's have been opened. Throws Failure: "unknown-node"; "cannot-collapse" where
// nothing is chosen, where a chosen node writes or checks (inside another graph it would not run), where a
// node outside lies between two inside, and where one list takes links from both.
Collapsed collapse(const Document& document, const Registry& registry, const std::vector<std::string>& names,
                   const CollapseOptions& options);

}  // namespace kinegraph
