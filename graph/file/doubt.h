// What isn't certain of a graph that was read past mistakes in its text, and which of its problems can be
// told all the same: a mistake is told once, and never what only follows from it.
#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "graph/diagnostic.h"
#include "graph/document.h"

namespace kinegraph {

struct Doubt {
  bool anywhere = false;  // see parse_json.h: part of the document may be missing or stand in the wrong place
  // Of a text with git's conflicts the document is what their first sides make, and this what their second
  // do: what isn't wrong with both only follows from the choice, unless it stands in a conflict (lines of its
  // markers).
  std::shared_ptr<const Document> other_side;
  std::vector<std::pair<int, int>> conflicts;
  // The line from which the document holds both sides, since nobody can tell them apart; 0: none.
  int torn_at = 0;
};

// Leaves of the problems of a document with conflicts those that are its own; `of_other` are those of
// the other side.
void drop_other_side(Diagnostics& problems, const Diagnostics& of_other, const Doubt& doubt);
// Where a value couldn't be read, takes out what was said of its meaning. Of a document in doubt `anywhere`,
// leaves only what is certain.
void drop_consequences(Diagnostics& problems, const Doubt& doubt);

bool stands_before(const Diagnostic& a, const Diagnostic& b);  // in the text

}  // namespace kinegraph
