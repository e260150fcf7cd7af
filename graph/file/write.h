// The canonical form of a graph file; see the contract's "Graph file".
#pragma once
#include <string>

#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

// Load-save is the identity on canonical files whose nodes are current. Parameters equal to their default are left out.
std::string write_document(const Document& document, const Registry& registry);
// Writes aside, syncs and renames: after a crash the old or the new file is there, whole. Throws Failure
// ("cannot-write") that names the path; the aside file is removed then. Keeps the permissions of a file it replaces and
// follows a symbolic link to the file it names.
void write_file_atomically(const std::string& path, std::string_view bytes);

}  // namespace kinegraph
