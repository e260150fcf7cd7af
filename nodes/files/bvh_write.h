// A motion to BVH text.
#pragma once
#include <string>

#include "graph/work.h"
#include "nodes/files/write_options.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The layout of bvh_channels.h; frame time as in the source while the rate is the source's. Characters that
// would end a name are replaced by `_` ("renamed-joint" warning). Throws Failure ("stretch", "not-finite"
// with joint and frame).
std::string write_bvh(const Motion& motion, const WriteOptions& options, Work& work);

}  // namespace kinegraph
