// What a run said, in an order for readers: notes first and faint, then warnings, then what failed, and last
// what was blocked by it, so that what needs doing stands nearest to the prompt.
#pragma once
#include <string>

#include "graph/evaluate/run_log.h"
#include "headless/terminal.h"

namespace kinegraph {

// `graph`: how the user named the graph file. Infos that several nodes say alike are one line; `tell_infos`:
// whether they are told at all.
void say_log(const Terminal& terminal, const RunLog& log, const std::string& graph, bool tell_infos = true);

}  // namespace kinegraph
