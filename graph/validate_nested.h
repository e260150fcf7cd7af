// What stands in the way of a graph inside the graph files that its Graph nodes name: there a missing clip or
// an unknown type stops only what needs it, so that the files themselves are fine and validate() is content.
#pragma once
#include "graph/validate.h"

namespace kinegraph {

// Of files that could be opened (see nested.h): "unknown-type" and "newer-version" (warnings) and, with
// `options.check_files`, "missing-file", "not-a-regular-file", "no-file", of the nodes inside that something
// published needs, samples that a link replaces and paths that the outer file sets left out. Each with the
// inner file (shown beside `options.file`), its place there and the node as outer/inner.
Diagnostics validate_nested(const Document& document, const Registry& registry,
                            const ValidateOptions& options);

}  // namespace kinegraph
