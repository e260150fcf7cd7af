// A state of a graph as git hands it over: under a made-up name, empty where the file wasn't there yet.
#pragma once
#include <string>

#include "headless/session.h"

namespace kinegraph {

// Like open_graph(); /dev/null and an empty file are a graph without nodes.
Opened version_of_graph(const std::string& argument, const Registry& registry);
// Says what is wrong with it, and with `infos` what is worth knowing. False where it can't be compared,
// merged or written back: errors, or a newer schema.
bool usable_version(const Program& program, const Opened& opened, bool infos = false);

}  // namespace kinegraph
