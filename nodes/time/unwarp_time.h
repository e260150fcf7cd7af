// Back to the source's own timing [Wu §6].
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/motion.h"
#include "nodes/time/warp.h"

namespace kinegraph {

// A motion on the warp's clock (usually an edited one) back on the source's: each source frame is taken at
// the centre of its run of rows, by Slerp; the encoded root is averaged over the run and integrated last; at
// skipped frames what the Warp kept is added back, so that an unedited motion returns within 1e-6. Frames
// that free ends left off hold the first or last row. The identity, and a warp that laid the reference on the
// source's clock, pass the motion on. Throws Failure ("wrong-length", "wrong-skeleton" at motion) where the
// motion isn't the warp's.
Motion unwarp_time(const Motion& motion, const Warp& warp, Work& work);

// What unwarp_time would miss of `source` at frames that no row shows, given `warped`, the source laid out by
// warp's paths.
std::vector<SkippedFrame> skipped_frames(const Motion& source, const EncodedRoot& root, const Motion& warped,
                                         const Warp& warp, Work& work);

// Which of warp.paths each of all_dofs(skeleton) follows. Throws as unwarp_time.
std::vector<std::size_t> path_of_each_dof(const Warp& warp, const Skeleton& skeleton);

}  // namespace kinegraph
