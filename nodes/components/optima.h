// Which of the optima that FastICA may end in is kept, and whether it is the only one.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/components/fast_ica.h"

namespace kinegraph {

// A run may have ended in an optimum that turning just two of its components would leave [Tichavský,
// Koldovský & Oja 2006, test of saddle points]: such turns are tried for every pair, and where one has a
// larger negentropy FastICA goes on from there. Returns the better run, or `run` (also where there are more
// than 20 components).
FastIcaRun leave_side_optimum(const Rows& z, FastIcaRun run, const FastIcaParams& params, Work& work);

// Runs from `best` with two of its components turned into each other by half a right angle: for the six pairs
// of which that costs least negentropy. None where there are more than 20 components.
std::vector<FastIcaRun> runs_around(const Rows& z, const FastIcaRun& best, const FastIcaParams& params,
                                    Work& work);

// The optimum is flat where other components are nearly as independent: where one of `others` converged to at
// least 0.9 of its negentropy. For each component of `best`: whether every such run has it too (|correlation|
// at least 0.95).
std::vector<bool> unique_components(const FastIcaRun& best, const std::vector<FastIcaRun>& others);

}  // namespace kinegraph
