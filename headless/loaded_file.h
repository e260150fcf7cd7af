// A file of a motion or an analysis as a graph of one Load node, so that a command that takes a file reads it
// exactly as a graph would.
#pragma once
#include <string>

#include "headless/session.h"

namespace kinegraph {

// The document: one node "load" of type Load.
Opened graph_of_file(const std::string& file);

// Runs the Load and returns the value of its output `port`, or of the first output that the file gives. Says
// what went wrong and throws Failure where there is none.
struct LoadedFile {
  ValuePtr value;
  std::string port;
};
LoadedFile load_file(Session& session, const Program& program, const std::string& port);

// A problem with the file at `path` in the words of whoever asked for it as `typed`.
Diagnostic as_typed(Diagnostic problem, const std::string& path, const std::string& typed);

}  // namespace kinegraph
