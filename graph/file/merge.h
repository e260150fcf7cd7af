// Three-way merge of graphs, in units: two people's work on one file put together.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

struct MergeConflict {
  std::string what;          // "transfer.root: 1 here, 2 there"
  std::optional<Unit> unit;  // under the merged names; nothing where it is of the graph as a whole
};

struct Merge {
  Document document;                     // with ours wherever the sides conflict
  std::vector<MergeConflict> conflicts;  // none: the merge is good
  std::string text;                      // canonical; with git's markers where the sides conflict
};

// All three are migrated and of the present schema. A node gone on one side and there under another name (see
// renames.h) is renamed: the other side's edits and links follow. Lists of links and of parameters merge by
// element, tables by key. What is only for the eye (ui) never conflicts. The result is validated: what is
// wrong with it and was so on neither side (a cycle, a link that leads nowhere, two nodes that write one
// file) is a conflict. `our_label`, `their_label` stand behind the markers. `open_inside` opens the files of
// a document's Graph nodes (see nested.h), so that their ports and parameters are known; without it any will
// do.
using OpenInside = std::function<void(Document&)>;
Merge merge(Document base, Document ours, Document theirs, const Registry& registry,
            const std::string& our_label = "ours", const std::string& their_label = "theirs",
            const OpenInside& open_inside = {});

}  // namespace kinegraph
