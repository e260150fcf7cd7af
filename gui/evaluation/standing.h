// How a whole graph stands, in a few words for the status line: the worst comes first.
#pragma once
#include <QString>

#include "graph/document.h"
#include "graph/registry.h"
#include "gui/evaluation/evaluation.h"

namespace kinegraph {

struct Standing {
  // quiet: nothing is wrong, but not all is computed.
  enum class Tone { quiet, good, busy, warning, error };
  Tone tone = Tone::quiet;
  QString words;  // "1 node failed · 2 nodes blocked"
};

// Of the nodes that compute something: Dots and disabled nodes don't count, Exports and Checks only where
// they have run, are blocked or not linked. "Up to date" is said only where every other node is.
Standing standing_of(const Document& document, const Registry& registry, const Evaluation& evaluation);
// While something is computed; `progress` receives 0 to 1, the mean over the nodes at work.
Standing standing_at_work(const Document& document, const Evaluation& evaluation, double* progress);

}  // namespace kinegraph
