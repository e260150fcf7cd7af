// Which joint of one skeleton does the work of which of another, whatever they are called.
#pragma once
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/body.h"

namespace kinegraph {

struct JointPairs {
  Body source, target;
  std::vector<int> source_of;  // for each joint of the target; -1 = none
  int source_pelvis = -1, target_pelvis = -1;
};

// Bodies first (pelvis, spine, neck, head, arms and legs, found by names, else by shape); then what else is
// called alike, sides and namespaces set aside, or stands in CMU's table, where it hangs below partners.
// Chains of different numbers of joints are paired from their ends, and what is left over in the middle has
// no partner.
//
// `map`: "FROM=TO" each, a joint of `source` and one of `target`; it overrides what was found. "=TO" and
// "FROM=" take a joint out. Throws Failure ("bad-map", "unknown-joint" at map[i]; "no-body",
// "no-common-joint") naming joints. Warns: "no-partner", naming the target's joints that stay at rest.
JointPairs pair_joints(const Skeleton& source, const Skeleton& target, const std::vector<std::string>& map,
                       Work& work);

}  // namespace kinegraph
