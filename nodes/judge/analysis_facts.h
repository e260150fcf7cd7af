// What a person wants to know of a file of components or metrics: what `kinegraph info` prints of it.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "graph/json.h"
#include "graph/value.h"

namespace kinegraph {

// Lines, each with what it tells; none where the value is of another kind.
std::vector<std::pair<std::string, std::string>> analysis_lines(const Value& value);
// The same as numbers; empty where the value is of another kind.
Json::Object analysis_json(const Value& value);

}  // namespace kinegraph
