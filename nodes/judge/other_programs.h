// What other programs will stumble over in a motion file, though it is read here.
#pragma once
#include "graph/diagnostic.h"
#include "nodes/motion/character.h"
#include "nodes/motion/motion.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// three-adds-offset: three.js adds OFFSET and position channels. three-names: it keeps the first word of a
// name and takes . : / [ ] in one for a path. assimp-names: it refuses BVH names with blanks. long-names:
// Blender cuts names off after 63 bytes. euler-wraps: channels that jump by 180° or more where the rotation
// hardly turns, which programs that interpolate channels take for a turn. no-end-site: chains that end in a
// joint. up-axis: the legs point along Z.
Diagnostics for_other_programs(const Motion& motion);
// up-axis: the points stretch along Z as a standing figure's do along its height.
Diagnostics for_other_programs(const Points& points);
// morph-weights: Blender holds the weights of morph targets between 0 and 1.
Diagnostics for_other_programs(const Character& character);

// The first few names, and how many more there are.
std::string some_of(const std::vector<std::string>& names);

}  // namespace kinegraph
