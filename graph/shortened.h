// As much of a long text as a message has room for.
#pragma once
#include <string>

namespace kinegraph {

// Whole up to 60 bytes; of a longer text its beginning, ended by "…".
std::string shortened(std::string text);

}  // namespace kinegraph
