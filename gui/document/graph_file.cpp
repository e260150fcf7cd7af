#include "gui/document/graph_file.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <algorithm>

#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/nested.h"
#include "graph/validate.h"

namespace kinegraph {
namespace {

bool is_graph(const Node& node, const Registry& registry) {
  const NodeType* type = node.missing ? nullptr : registry.find(node.type);
  return type && type->role == Role::graph;
}

// The bytes of a regular file; throws Failure with why there are none.
std::string bytes_of(const QString& path, const char* code) {
  const QFileInfo info(path);
  QFile file(path);
  const bool readable = (info.isFile() || !info.exists()) && file.open(QIODevice::ReadOnly);
  if (!readable)
    throw Failure(error(code, !info.exists()   ? "there is no such file"
                              : !info.isFile() ? "it is not a regular file"
                                               : file.errorString().toStdString())
                      .in_file(path.toStdString()));
  return file.readAll().toStdString();
}

QString folder_of(const QString& path) {
  return path.isEmpty() ? QDir::currentPath() : QFileInfo(path).absolutePath();
}

}  // namespace

bool has_graphs_inside(const Document& document, const Registry& registry) {
  return std::any_of(document.nodes.begin(), document.nodes.end(),
                     [&](const auto& entry) { return is_graph(entry.second, registry); });
}

Document graph_nodes_of(const Document& document, const Registry& registry) {
  Document found;
  found.variables = document.variables;
  for (const auto& [name, node] : document.nodes)
    if (is_graph(node, registry)) found.nodes.emplace(name, node);
  return found;
}

void open_graphs_inside(Document& document, const Registry& registry, const QString& path,
                        const QString& folder, const OpenGraphs& open, const StopToken& stop) {
  NestedOptions options;
  options.path = path.toStdString();
  options.folder = options.set_folder = folder.toStdString();
  options.read = [&](const std::string& file) {
    if (stop.stopped()) throw Cancelled();
    const auto page = open.find(file);
    if (page != open.end()) return write_document(*page->second, registry);
    return bytes_of(QString::fromStdString(file), "missing-file");
  };
  open_nested(document, registry, options);
}

GraphFile read_graph_text(const std::string& text, const QString& path, const Registry& registry,
                          const OpenGraphs& open, const StopToken& stop) {
  GraphFile file{path, text, {}, {}};
  const std::string shown = path.isEmpty() ? "untitled" : path.toStdString();
  ReadResult read = read_document(text, shown, registry);
  file.document = std::move(read.document);
  file.problems = std::move(read.problems);
  if (stop.stopped()) throw Cancelled();
  const QString folder = folder_of(path);
  if (has_graphs_inside(file.document, registry))
    open_graphs_inside(file.document, registry, path, folder, open, stop);
  if (file.opens()) return file;
  ValidateOptions options;
  options.file = shown;
  options.folder = folder.toStdString();
  options.allow_presets = true;
  file.problems = all_problems(file.document, std::move(file.problems), read.doubt, registry, options);
  return file;
}

GraphFile read_graph_file(const QString& path, const Registry& registry, const OpenGraphs& open,
                          const StopToken& stop) {
  const QString absolute = QFileInfo(path).absoluteFilePath();
  try {
    return read_graph_text(bytes_of(absolute, "unreadable-file"), absolute, registry, open, stop);
  } catch (const Failure& failure) {
    GraphFile unreadable{absolute, {}, {}, {}};
    unreadable.problems = {error(failure.diagnostic().code, "can't be read: " + failure.diagnostic().message)
                               .in_file(absolute.toStdString())
                               .hinting("check that the file is there and may be read")};
    return unreadable;
  }
}

}  // namespace kinegraph
