// What the Metrics nodes of a run measured, side by side.
#pragma once
#include <string>
#include <vector>

#include "headless/outcome.h"

namespace kinegraph {

// A row a metric of the whole body (not those of single joints), a column a node; "-" where nothing could be
// measured. "" without columns.
std::string metrics_table(const Terminal& terminal, const std::vector<std::string>& columns,
                          const std::vector<std::shared_ptr<const Metrics>>& values);

// The measured nodes of type Metrics in the order in which data flows through the graph; names decide ties.
std::vector<std::string> metrics_columns(const Plan& plan, const Outcome& outcome);

}  // namespace kinegraph
