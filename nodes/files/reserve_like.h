// Room for a table's text before it is written.
#pragma once
#include <cstddef>
#include <string>

namespace kinegraph {

// Room for all `rows`, of which `text` holds the first `done` (not 0): growing a text of a hundred megabytes
// would copy it for longer than anyone who asks a writer to stop should wait.
inline void reserve_like(std::string& text, std::size_t done, std::size_t rows) {
  text.reserve(text.size() / done * (rows + rows / 16 + 1));
}

}  // namespace kinegraph
