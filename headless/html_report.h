// The report as one page for a browser: the graph drawn, times, cache hits, diagnostics, metrics, and a
// player of the motions that were written, before and after. It holds everything it needs and asks nothing of
// any network.
#pragma once
#include <string>
#include <vector>

#include "headless/outcome.h"

namespace kinegraph {

// A motion that was written and what it was made from.
struct BeforeAfter {
  std::string name;      // of the Export, or "node.port" of a published output
  Target before, after;  // before.node "" = nothing to compare with
};
// By the main input (the first of a motion or points) from each Export, or named output, back to where it
// came from; of a Check what it judges, with the baseline where nothing lies before.
std::vector<BeforeAfter> motions_to_show(const Session& session, const std::vector<Target>& targets);

std::string html_of(const Outcome& outcome, const Program& program, Session& session,
                    const std::vector<BeforeAfter>& shown);

}  // namespace kinegraph
