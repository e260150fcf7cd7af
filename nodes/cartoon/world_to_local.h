// From world positions and orientations back to a motion.
#pragma once
#include <memory>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The motion on `skeleton` whose joints stand and are turned as in `world` (its scale must be the
// skeleton's). A joint gets a translation track where `translates` says so or its place leaves the rest
// offset by over 1e-10 of the skeleton's height in any frame.
Motion motion_from_world(std::shared_ptr<const Skeleton> skeleton, std::shared_ptr<const SourceFacts> source,
                         double fps, std::vector<bool> translates, const WorldMotion& world, Work& work);

}  // namespace kinegraph
