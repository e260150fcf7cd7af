// How the joints of two standing bodies correspond, before any frame is looked at.
#pragma once
#include <vector>

#include "nodes/time/joint_pairs.h"
#include "nodes/time/standing_pose.h"

namespace kinegraph {

// What a joint of the target does.
struct LinkPlan {
  int source = -1;  // its partner
  Quat follow;      // O_t = O_s follow
  // The aligned link: to this joint of the target, whose partner is `source_to`; -1 = none.
  int to = -1, source_to = -1;
  double shape = 0;  // rad by which a link differs that is left as the target stands
};

std::vector<LinkPlan> plan_links(const Skeleton& source, const Skeleton& target, const JointPairs& pairs,
                                 const StandingPose& source_stands, const StandingPose& target_stands);

}  // namespace kinegraph
