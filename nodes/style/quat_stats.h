// The statistics of a motion that carry its style [Wu §5]: each joint's mean and spread, and those of the
// encoded root.
#pragma once
#include <span>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/motion.h"
#include "nodes/style/stats.h"

namespace kinegraph {

enum class MeanKind { karcher, slerp };
enum class StyleSpace { quaternion, euler };
const char* name_of(MeanKind kind);
const char* name_of(StyleSpace space);

struct QuatStatsParams {
  MeanKind mean = MeanKind::karcher;
  StyleSpace space = StyleSpace::quaternion;
  std::vector<bool> joints;  // one flag a joint; empty = all
  std::size_t start = 0;     // frames measured: [start, end); end 0 = to the end
  std::size_t end = 0;
};

// Spreads are over all frames measured (N, not N − 1). The root's rotation is ρ of the encoded root, in
// either space. Travel and heading are measured from the second frame on. Throws Failure ("no-frames"); warns
// where the rotations of a joint are spread so far that they have no mean to rely on ("no-clear-mean").
Stats quat_stats(const Motion& motion, const QuatStatsParams& params, Work& work);
// The same, for a caller that has encoded the root already.
Stats quat_stats(const Motion& motion, const EncodedRoot& root, const QuatStatsParams& params, Work& work);

}  // namespace kinegraph
