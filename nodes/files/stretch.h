// What to do with bone lengths that vary, before a motion is written.
#pragma once
#include <string_view>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// keep: the motion as it is. error: throws Failure ("stretch") naming the first joint and frame whose
// translation leaves the rest offset by over 1e-6 of its length (or 1e-9 m). drop: a motion in which only the
// root translates; the farthest that was dropped is reported ("stretch-dropped").
Motion without_stretch(const Motion& motion, std::string_view stretch, Work& work);

}  // namespace kinegraph
