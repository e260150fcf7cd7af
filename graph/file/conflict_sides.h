// A text with git's conflict markers, taken apart: as the first sides of its conflicts have it, and as the
// second.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "graph/diagnostic.h"

namespace kinegraph {

struct ConflictSides {
  Diagnostics problems;  // "conflict-markers", one a conflict, at its first marker
  // The text without markers and without what only the other sides (and the common ancestor, in diff3's
  // style) hold. What is left out leaves empty lines, so that every line keeps its number.
  std::string first, second;
  std::vector<std::pair<int, int>> blocks;  // lines of the markers that each conflict begins and ends with
  // The line of the first marker that stands without its others, or 0. Nobody can tell where the sides begin
  // and end, and from there on both texts hold all of them.
  int torn_at = 0;
};
// Nothing where the text has no markers. They begin a line, where JSON can hold no text of its own: a string
// has no raw line break in it. A conflict inside another's side, as merging merges gives them, belongs to
// that one.
std::optional<ConflictSides> conflict_sides(std::string_view text);

}  // namespace kinegraph
