// Parameters that several nodes share: joints, range, fade, amount, map.
#pragma once
#include <string>
#include <vector>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

void add_joints_param(NodeType& type);
void add_range_param(NodeType& type);
void add_fade_param(NodeType& type);    // seconds, blends in and out of the range
void add_amount_param(NodeType& type);  // 0 = the input
void add_map_param(NodeType& type);

// Weight of a change at each frame: amount inside the range, fading over `fade` seconds outwards... 0
// outside. A fade lies inside the range, C1 (smoothstep), and only at ends that are not the motion's own.
std::vector<double> change_weights(const Params& params, std::size_t frames, double fps);
// A range checked against a length: throws Failure ("bad-range") at `param` when it is empty or starts past
// the end; an end past the last frame is an error too.
struct Frames {
  std::size_t start, end;
};
Frames checked_range(const FrameRange& range, std::size_t frames, std::string_view param);
// Replaces `changed` where joints aren't chosen or weights are below 1, blending rotations by Slerp. Both
// have the same skeleton and frames. The root's position is blended too when the root is chosen.
Motion blended_change(const Motion& input, const Motion& changed, const std::vector<bool>& joints,
                      const std::vector<double>& weights);
// Throws Failure ("rate-mismatch") naming Resample.
void check_same_rate(double a, double b, std::string_view port_a, std::string_view port_b);
// Rest poses that differ by more than 5° at a mapped link: a warning ("rest-pose-differs") that names
// Retarget. And joints without a partner, named in one warning ("no-partner"). `chosen`: only these joints of
// `to` count; null: all.
void warn_about_partners(const Skeleton& from, const Skeleton& to, const std::vector<int>& partner_of_to,
                         Work& work, const std::vector<bool>* chosen = nullptr);
// "Hips, Spine, Head": at most eight, and how many more.
std::string listed(const std::vector<std::string>& names);

}  // namespace kinegraph
