// Keeps a stretch of a motion's frames.
#pragma once
#include "nodes/motion/motion.h"
#include "nodes/node_params.h"

namespace kinegraph {

// Frames [start, end) as they are. The angles as read from the file stay with their frames.
Motion trimmed(const Motion& motion, Frames range);

}  // namespace kinegraph
