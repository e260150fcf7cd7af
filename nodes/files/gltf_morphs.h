// Morph targets as other programs can move them.
#pragma once
#include <cstddef>
#include <vector>

#include "graph/json.h"
#include "nodes/motion/character.h"

namespace kinegraph {

// How many morph targets of each part its source file has; 0 without one. `root`: that file's JSON.
std::vector<std::size_t> source_targets(const Character& character, const Json& root);

// glTF sets no bounds to the weight of a morph target; Blender holds it between 0 and 1, as many a slider
// does. So each new target (from number `had` of its part on) that a track takes out of these bounds becomes
// up to two, NAME and, the other way, NAME-, as large as its largest weight: all weights are then from 0 to
// 1, and every vertex goes where it went. Targets that the source has stay as they are.
Character with_weights_from_0_to_1(const Character& character, const std::vector<std::size_t>& had);

}  // namespace kinegraph
