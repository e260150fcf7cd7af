// Entries of a ComponentEdit's `edits`, as clicks in the components dock write them. Components count from 1.
#pragma once
#include <string>
#include <vector>

#include "graph/json.h"

namespace kinegraph {

// The list with `op` ("scale": "factor", "translate": "value") of a component set to a number: the last entry
// that does this alone is changed, else one is added.
Json with_amount(const Json& edits, const std::string& op, int component, double amount);
// What those entries do to a component all in all: 1 (scale) or 0 (translate) where there are none.
double amount_of(const Json& edits, const std::string& op, int component);
Json with_merge(const Json& edits, const std::vector<int>& components);
Json with_transfer(const Json& edits, const std::vector<int>& components, int from, int to);
// What the edits do, in a few words each: "u2 × 0", "u3 + 1.5".
std::vector<std::string> told(const Json& edits);

}  // namespace kinegraph
