// Meaning of a whole document that reading alone can't see: links that lead nowhere or don't fit, required
// ports left open, cycles, publishing, undefined variables, paths, files that are missing.
#pragma once
#include <map>
#include <string>

#include "graph/document.h"
#include "graph/file/read.h"
#include "graph/registry.h"
#include "graph/variables.h"

namespace kinegraph {

struct ValidateOptions {
  std::string file;            // how messages name the graph
  std::string folder;          // absolute; relative paths in the graph start here
  bool check_files = true;     // missing input files are errors
  bool allow_outside = false;  // files may be written outside the folder
  bool allow_presets =
      false;  // of a graph of one node, whose user links it, an open input is only worth knowing
  std::map<std::string, Json>
      variables;  // given with --var: they come before the document's (see variables.h)
  // Of the files that this one lies inside, outermost first: they come before its own.
  std::vector<const std::map<std::string, Json, std::less<>>*> outer_variables;
};
// Every problem, in file order. Places point into the file where the document was read from one. A document
// that could be read only in part is checked as far as it goes. Codes: "unknown-node", "unknown-port",
// "type-mismatch", "open-input", "cycle", "index-out-of-range", "unknown-param", "needs-list", "one-link",
// "missing-file", "broken-graph", "graph-cycle", "too-many-graphs" (of a Graph node's file; see nested.h),
// "undefined-variable" and the others of substituted(), those of check(), "absolute-path" and
// "backslash-path" (warnings), those of NodeType::misfits, "leads-outside", "missing-file",
// "not-a-regular-file", "unreadable-file", "same-file".
Diagnostics validate(const Document& document, const Registry& registry, const ValidateOptions& options);

// What reading found and what validate() finds, each once, without what only follows from something else, in
// file order.
Diagnostics all_problems(const Document& document, Diagnostics found_by_reading, const Doubt& doubt,
                         const Registry& registry, const ValidateOptions& options);
// Reads and validates: all problems of a file at once, in file order.
ReadResult read_and_validate(std::string_view text, const Registry& registry, const ValidateOptions& options);

}  // namespace kinegraph
