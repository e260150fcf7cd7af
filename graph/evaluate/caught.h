// The exception being handled, as a diagnostic: whatever code a node calls may throw.
#pragma once
#include "graph/diagnostic.h"

namespace kinegraph {

// Call it inside a catch block. A Failure gives its own; std::bad_alloc "out-of-memory"; anything else
// "internal".
Diagnostic caught();

}  // namespace kinegraph
