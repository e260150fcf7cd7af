// Warnings belong to a key, which holds no path: before they are kept, paths are taken out of them, and
// whoever asks gets its own paths put in.
#pragma once
#include <vector>

#include "graph/diagnostic.h"
#include "graph/evaluate/node_key.h"

namespace kinegraph {

// Each of the node's paths becomes a mark that counts its files. A place in a text without a file's name is
// taken to be in the first of them.
Diagnostic without_paths(Diagnostic note, const std::vector<NodeFile>& files);
// Marks become the paths as the user wrote them.
Diagnostic with_paths(Diagnostic note, const std::vector<NodeFile>& files);

}  // namespace kinegraph
