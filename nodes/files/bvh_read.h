// BVH text to a motion.
#pragma once
#include <string_view>

#include "graph/work.h"
#include "nodes/files/read_options.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// A joint's position channels replace its OFFSET, as in Blender and MotionBuilder; an axis without one keeps
// the OFFSET's. A joint's translation is a track where it varies, or stays apart from an OFFSET that isn't
// zero; position channels that stand still over no OFFSET give the rest offset. The root with position
// channels always has a track. `Frames: 0` gives a motion without frames ("no-frames" warning). The unit,
// where it was guessed, is told as an info
// ("unit-found"). Throws Failure with line and column, see bvh_hierarchy.h and bvh_numbers.h, and "too-large"
// with joint and frame for values past 1e9.
Motion read_bvh(std::string_view text, const ReadOptions& options, Work& work);

}  // namespace kinegraph
