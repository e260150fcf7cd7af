// The strict reader of *.kg.json. It reports every problem of a file at once, each with line and column.
#pragma once
#include <string>
#include <string_view>

#include "graph/document.h"
#include "graph/file/parse_json.h"
#include "graph/registry.h"

namespace kinegraph {

struct ReadResult {
  Document document;      // as far as it could be read; migrated to current versions in memory
  Diagnostics problems;   // with an error among them the document must not be run or saved
  bool migrated = false;
};
// Text -> Document. Shape, names, node types and versions, parameter names and types against the registry, port names,
// link syntax; migrates old nodes; keeps unknown types and newer versions as missing nodes (a warning each); a newer
// schema gives a read-only document (warning "newer-schema"). `migrate` false: old nodes stay as they stand (fmt).
ReadResult read_document(std::string_view text, const std::string& file, const Registry& registry, bool migrate = true);

}  // namespace kinegraph
