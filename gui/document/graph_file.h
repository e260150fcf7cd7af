// A graph file as the editor opens it, with the graph files inside it. Reading and parsing take as long as
// disk and files want; everything here may run on any thread.
#pragma once
#include <QString>
#include <map>
#include <memory>
#include <string>

#include "graph/diagnostic.h"
#include "graph/document.h"
#include "graph/evaluate/stop.h"
#include "graph/registry.h"

namespace kinegraph {

// Graphs that are open with unsaved changes, by absolute path: they stand for their files.
using OpenGraphs = std::map<std::string, std::shared_ptr<const Document>>;

struct GraphFile {
  QString path;  // absolute
  std::string text;
  Document document;  // the graph files inside it opened
  // Of a file that opens, warnings of reading. Of one that doesn't, all that is wrong with it, as
  // `kinegraph validate` tells it.
  Diagnostics problems;
  bool opens() const { return !has_error(problems); }
};

// Throws Cancelled.
GraphFile read_graph_file(const QString& path, const Registry& registry, const OpenGraphs& open,
                          const StopToken& stop);
// The same of a text; `path` "" where there is no file.
GraphFile read_graph_text(const std::string& text, const QString& path, const Registry& registry,
                          const OpenGraphs& open, const StopToken& stop);

bool has_graphs_inside(const Document& document, const Registry& registry);
// What open_nested() looks at: the Graph nodes alone.
Document graph_nodes_of(const Document& document, const Registry& registry);
// `path` as above; `folder` absolute. Throws Cancelled.
void open_graphs_inside(Document& document, const Registry& registry, const QString& path,
                        const QString& folder, const OpenGraphs& open, const StopToken& stop);

}  // namespace kinegraph
