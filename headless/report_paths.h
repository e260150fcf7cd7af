// Reports go to files of their own.
#pragma once
#include "headless/session.h"

namespace kinegraph {

// Throws UsageError where --report, --junit or --html name a graph, a file that the run reads or writes, or
// each other: a slip of the hand would cost the clip or the graph.
void check_report_paths(const RunArguments& arguments, const Session& session);

}  // namespace kinegraph
