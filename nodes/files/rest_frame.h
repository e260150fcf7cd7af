// The T-pose that converters of CMU's files put in front of a clip.
#pragma once
#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// Whether frame 0 is a pose near the rest pose from which the motion jumps away: in the mean over the joints
// it turns by 1.5° and 5 times more from frame 0 to 1 than it does later (the median of frames 2 to 10, for
// some converters smear the jump over frame 1), and is at least twice as far from the rest pose in frame 1.
// Needs four frames.
bool starts_with_rest_frame(const Motion& motion);
// Warns ("rest-frame") when `file_frame` is 0 and it does.
void warn_about_rest_frame(const Motion& motion, std::size_t file_frame, Work& work);

}  // namespace kinegraph
