// Meaning of a whole document that reading alone can't see: links that lead nowhere or don't fit, required ports left
// open, cycles, publishing, undefined variables, paths, files that are missing.
#pragma once
#include <map>
#include <string>

#include "graph/document.h"
#include "graph/registry.h"
#include "graph/variables.h"

namespace kinegraph {

struct ValidateOptions {
  std::string file;       // how messages name the graph
  std::string folder;     // absolute; relative paths in the graph start here
  bool check_files = true;  // missing input files are errors
  bool allow_outside = false;  // files may be written outside the folder
  std::map<std::string, Json> variables;  // given with --var: they come before the document's (see variables.h)
};
// Every problem, in file order. Places point into the file where the document was read from one.
Diagnostics validate(const Document& document, const Registry& registry, const ValidateOptions& options);

}  // namespace kinegraph
