// What changed in meaning between two states of a graph, in units.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "graph/edit.h"
#include "graph/file/renames.h"

namespace kinegraph {

struct Diff {
  Renames renames;
  // Under the new names. A node that is only in one of the two is one whole-node change; so is one whose type
  // changed.
  std::vector<Change> changes;
  bool layout = false;  // ui differs; it has no meaning and is not among the changes
  bool empty() const { return renames.empty() && changes.empty(); }
};
Diff diff(const Document& before, const Document& after);
// The one edit that makes `before` into `after`, its layout too: a merge or a recovered file as one undo
// step.
Edit edit_between(const Document& before, const Document& after, std::string title);

// {"renamed": {OLD: NEW}, "changes": [{"kind", "name", "key", "before", "after"}], "layout"}; what is absent
// is left out.
Json to_json(const Diff& diff);
const char* name_of(Unit::Kind kind);  // "node", "param", "publish-output" …

// A document as one line a unit, each understandable alone: for `git diff`, whose hunks then need no context.
// No ui.
std::string unit_lines(const Document& document);

}  // namespace kinegraph
