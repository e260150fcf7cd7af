// The units of which a document is made up, listed: what diff and merge walk through.
#pragma once
#include <string>
#include <vector>

#include "graph/document.h"

namespace kinegraph {

// The parts of a node, in the file's order: type, enabled, note, params, inputs, extras. Of a missing node
// those of the object it is kept as. Nothing where there is no such node.
std::vector<Unit> units_of_node(const Document& document, const std::string& name);
// What belongs to no node and means something: variables, publish, extras. No ui.
std::vector<Unit> units_of_file(const Document& document);
std::vector<Unit> units_of_ui(const Document& document);

// Whether two nodes are the same in all that is saved: then none of their units differs.
bool same(const Node& a, const Node& b);

// Calls `each(key, was, our, their)` for every key of the three maps, in order, with null where one lacks it.
template <class Map, class Each>
void in_step(const Map& base, const Map& ours, const Map& theirs, const Each& each) {
  auto a = base.begin(), b = ours.begin(), c = theirs.begin();
  while (a != base.end() || b != ours.end() || c != theirs.end()) {
    const std::string* first = nullptr;
    const auto look = [&](const auto& at, const Map& map) {
      if (at != map.end() && (!first || at->first < *first)) first = &at->first;
    };
    look(a, base), look(b, ours), look(c, theirs);
    const std::string& key = *first;
    const auto take = [&](auto& at, const Map& map) -> const typename Map::mapped_type* {
      if (at == map.end() || (&at->first != &key && at->first != key)) return nullptr;
      return &(at++)->second;
    };
    const auto *was = take(a, base), *our = take(b, ours), *their = take(c, theirs);
    each(key, was, our, their);
  }
}

}  // namespace kinegraph
