// How the joints of two standing bodies correspond, before any frame is looked at.
#pragma once
#include <vector>

#include "nodes/time/joint_pairs.h"
#include "nodes/time/standing_pose.h"

namespace kinegraph {

// What a foot has in common with the source's.
enum class FeetBy { sole, direction };

// What a joint of the target does.
struct LinkPlan {
  int source = -1;  // its partner
  Quat follow;      // O_t = O_s follow
  // The aligned link: to this joint of the target, whose partner is `source_to`; -1 = none.
  int to = -1, source_to = -1;
  // Of the link that ends here and can't be turned to the source's direction, as its joint has others or is a
  // foot's: rad by which they differ as the bodies stand, and the joint at its start; -1 = none such.
  double shape = 0;
  int shape_of = -1;
};

std::vector<LinkPlan> plan_links(const Skeleton& source, const Skeleton& target, const JointPairs& pairs,
                                 const StandingPose& source_stands, const StandingPose& target_stands,
                                 FeetBy feet_by);

}  // namespace kinegraph
