// Files whose root stays at the world's origin while a joint below it carries the body: exporters of game
// engines and motion studios put such a reference joint on top. What works on a root's path and heading would
// find none.
#pragma once
#include <memory>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The same motion, every joint in the same place at every frame, told so that the root goes with the body: it
// stands where the first joint below it that translates and carries both legs stands, turned by that joint's
// heading. The motion itself where its root moves, or nothing below it carries the body.
std::shared_ptr<const Motion> with_moving_root(std::shared_ptr<const Motion> motion, Work& work);

}  // namespace kinegraph
