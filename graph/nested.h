// Graph files inside graphs: what a Graph node stands for once its file is read. A Graph node has no ports
// and parameters of its own but those its file publishes, so its node type is made from the file.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "graph/document.h"
#include "graph/registry.h"
#include "graph/variables.h"

namespace kinegraph {

struct Nested {
  std::string path;    // absolute
  std::string folder;  // of the file: its paths start here
  std::shared_ptr<const Document>
      document;                          // its own Graph nodes opened too; null where the file can't be used
  std::shared_ptr<const NodeType> type;  // likewise: "file" and what is published
  Diagnostic why;  // why it can't: "missing-file", "broken-graph", "graph-cycle", "too-many-graphs"
};

struct NestedOptions {
  std::string path;                          // absolute, of the graph file itself; "" = it is none
  std::string folder;                        // absolute
  std::string set_folder;                    // absolute folder that `files` start from
  std::map<std::string, Json> variables;     // given with --var
  std::map<std::string, std::string> files;  // Graph node -> file, set on the command line
  // The text of a file; throws Failure where it can't be read.
  std::function<std::string(const std::string& absolute_path)> read;
};
// Reads the file of every Graph node, and theirs, and keeps in each node what was found; what was kept before
// goes. Names that lead from file to file in a circle are told by validate(), as is whatever else is wrong.
void open_nested(Document& document, const Registry& registry, const NestedOptions& options);

// The type of a node with its ports and parameters as they are: a Graph node's come from its file. Null for a
// missing node, which one is whose file can't be used.
const NodeType* known_type(const Registry& registry, const Node& node);
// A Graph node whose file nobody has opened: its ports can't be told, so any may be meant.
bool is_unopened(const NodeType& type, const Node& node);

}  // namespace kinegraph
