// A large JSON value as text, by one who may be asked to stop.
#pragma once
#include <string>

#include "graph/json.h"
#include "graph/work.h"

namespace kinegraph {

// As indented() of json.h; asks `work` at least once in each 64 KiB of text.
std::string indented(const Json& value, Work& work);

}  // namespace kinegraph
