// The sub-joint hierarchy [Kwon §5.1]: every link with one joint below it is cut into several.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "graph/work.h"
#include "nodes/cartoon/group_curve.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// J′_{k,l}: the l-th of the m_k sub-joints of joint k. J′_{k,1} is the joint itself, J′_{k,l} lies (l −
// 1)/m_k along its link.
struct SubJoint {
  int joint = 0;    // k
  int step = 0;     // l − 1
  int count = 1;    // m_k
  int next = -1;    // joint at the lower end of k's link; -1 where k has one sub-joint
  int parent = -1;  // sub-joint above
  double part() const { return static_cast<double>(step) / count; }
};

struct SubJoints {
  std::vector<SubJoint> all;             // parents before children
  std::vector<int> first;                // J′_{k,1} of joint k
  std::vector<std::vector<int>> groups;  // of joints
  // Each sub-joint's place as weights of the joints' places.
  std::vector<std::vector<std::pair<int, double>>> weights;
};

struct SubJointParams {
  // Of each joint, over everything else; where the joint has no single child it counts as 1. Empty = as
  // below.
  std::vector<int> of_each;
  std::vector<std::pair<std::string, int>> counts;  // pattern → sub-joints of a link; the rest by length
  std::vector<std::pair<std::string, std::string>> groups;  // first and last joint; empty = automatic
  std::string prune;  // pattern of joints that don't count as children; empty = fingers, thumbs, toe ends
};

// Without a count given, a link of length v gets round(v / (0.0425 height)) sub-joints, at least 1, at most
// 12: 58 on Gait's skeleton of 23 joints. The height is the rest pose's, or, where that is folded or
// lies, 1.15 times the longest way from the first branching joint to a tip. One sub-joint each have
// joints whose number of children, pruned ones left out, isn't one, those from the root to the first
// branching joint (which place the body, as a root on the ground does), and those that sit on a branching
// joint (CMU's LHipJoint and LeftShoulder): their links cross the trunk, whose skin is bound to them. Where
// the rest pose has no lengths, those of the first frame stand in. Throws as named_groups and chosen_joints
// do, and ("bad-value") at `sub_joints` for a count over 1 on a joint with no single child, if named exactly.
SubJoints lay_sub_joints(const Motion& motion, const SubJointParams& params, Work& work);

}  // namespace kinegraph
