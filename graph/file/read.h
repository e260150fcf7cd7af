// The strict reader of *.kg.json. It reports every problem of a file at once, each with line and column.
#pragma once
#include <string>
#include <string_view>

#include "graph/document.h"
#include "graph/file/doubt.h"
#include "graph/registry.h"

namespace kinegraph {

struct ReadResult {
  Document document;     // as far as it could be read; migrated to current versions in memory
  Diagnostics problems;  // with an error among them the document must not be run or saved
  bool migrated = false;
  Doubt doubt;
};
// Text -> Document: shape and keys, names, node types and versions, parameter and port names, link syntax. Whether values
// fit their parameters and links lead somewhere is for validate() to say, which also works on a document with problems.
// Migrates old nodes (an info "old-version" each); keeps unknown types and newer versions as missing nodes (warnings
// "unknown-type", "newer-version"); a newer schema gives a read-only document (warning "newer-schema"). `migrate` false:
// old nodes are checked, but stay as they stand (fmt).
// Codes: those of parse_json(), "not-a-graph", "wrong-type", "missing-key", "unknown-key", "bad-name", "bad-version",
// "unknown-param", "unknown-port", "bad-link", "needs-list", "one-link", "not-an-integer".
ReadResult read_document(std::string_view text, const std::string& file, const Registry& registry, bool migrate = true);

}  // namespace kinegraph
