// What is wrong with a graph's text before it is read as JSON: bytes that aren't UTF-8, git's conflict
// markers.
#pragma once
#include <string>
#include <string_view>

#include "graph/diagnostic.h"

namespace kinegraph {

// The offset of the first byte that isn't UTF-8 (RFC 3629: no overlong forms, no surrogates), or npos.
std::size_t first_bad_utf8(std::string_view text);
// The text with a ? for each byte that isn't UTF-8; the first of each line is told ("bad-utf8").
std::string as_utf8(std::string_view text, Diagnostics& found);
// Git's markers ("conflict-markers") begin a line, where JSON can hold no text of its own: a string has no
// raw line break in it.
void find_conflict_markers(std::string_view text, Diagnostics& found);

}  // namespace kinegraph
