// Files whose root stays at the world's origin while a joint below it carries the body: exporters of game
// engines and motion studios put such a reference joint on top. What works on a root's path and heading would
// find none.
#pragma once
#include <memory>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The same motion, every joint in the same place at every frame, told so that the root goes with the body: it
// stands where the first joint below it that translates and carries both legs stands, turned by that joint's
// heading. The motion itself where its root moves, or nothing below it carries the body.
std::shared_ptr<const Motion> with_moving_root(std::shared_ptr<const Motion> motion, Work& work);

// Motions that will be mixed or joined: where one is told so, each other whose root stands still and that has
// a joint of that name is told so too, by that joint, even if nothing moves in it.
std::vector<std::shared_ptr<const Motion>> with_moving_roots(
    std::vector<std::shared_ptr<const Motion>> motions, Work& work);

// A joint below the root that all legs hang on. The way down to it tells where the body stands; it is no bone
// with a length to keep.
bool carries_the_legs(const Skeleton& skeleton, int joint);

}  // namespace kinegraph
