// Laying two segments of components on one clock by dynamic time warping [Shapiro §4.2, Cao §6.8].
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/work.h"
#include "nodes/components/components.h"
#include "nodes/time/dynamic_time_warp.h"

namespace kinegraph {

// What is compared: entries `u3`, `group:NAME`, `joint:PATTERN`, `dof:JOINT.x`. None: all joints of motions,
// all components of points. Each is taken about the segment's own mean, so that a difference of style doesn't
// bend time. Throws Failure at `param`: "bad-align", "unknown-component", "unknown-joint", "no-features"
// (nothing moves). Found once for the same clips, signals and entries (component_memory.h).
Correspondence aligned_segments(const Components& components, const ComponentSegment& a,
                                const ComponentSegment& b, const std::vector<std::string>& align,
                                std::string_view param, Work& work);

// At every frame of one the time in frames of the other, smooth where a frame was held.
struct ClockMaps {
  std::vector<double> b_of_a, a_of_b;
};
// `lowpass`: Hz, 0 = not smoothed further.
ClockMaps clock_maps(const Correspondence& path, std::size_t a_frames, std::size_t b_frames, double fps,
                     double lowpass);

// A clip or rows at other times (in frames, fractional): Slerp, linear.
Rows at_times(const Rows& rows, const std::vector<double>& times);
Motion at_times(const Motion& motion, const std::vector<double>& times);
Points at_times(const Points& points, const std::vector<double>& times);

}  // namespace kinegraph
