// C3D, the binary format of markers.
#pragma once
#include <string>
#include <string_view>

#include "graph/work.h"
#include "nodes/files/read_options.h"
#include "nodes/files/write_options.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// Intel, DEC and SGI; whole and real coordinates. A sample with a negative residual is missing. Frames count
// from 0 whatever the file's first frame. Where header and parameters contradict each other, what fits the
// file's length is taken, with a warning ("frame-count", "data-start"). Throws Failure ("not-c3d",
// "truncated", "bad-parameters", "unknown-unit", "bad-rate").
Points read_c3d(std::string_view bytes, const ReadOptions& options, Work& work);
// Intel, reals (float32).
std::string write_c3d(const Points& points, const WriteOptions& options, Work& work);

}  // namespace kinegraph
