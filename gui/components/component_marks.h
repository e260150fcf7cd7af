// What the edits of a ComponentEdit do to one component, as the badge on its figure tells it.
#pragma once
#include <string>

#include "graph/json.h"

namespace kinegraph {

// "× 1.3  + 0.5", "→ swing" (merged into it), "0 → 1" (given by one clip to another), "replaced"; "" where
// nothing touches it. Components count from 1.
std::string mark_of(const Json& edits, int component);

}  // namespace kinegraph
