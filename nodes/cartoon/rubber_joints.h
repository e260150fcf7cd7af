// Rubber limbs by a sub-joint hierarchy [Kwon §5].
#pragma once
#include <memory>
#include <vector>

#include "graph/work.h"
#include "nodes/cartoon/mass_spring.h"
#include "nodes/cartoon/sub_joints.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct RubberParams {
  SubJointParams sub_joints;
  bool simulate = true;
  MassSpringParams springs;
  double blend = 0.7;  // result = (1 − blend) s + blend x
};

struct RubberResult {
  Motion motion;  // on the sub-joint skeleton, whose rest pose is the input's put through the same curves
  SubJoints sub_joints;
};

// The skeleton of sub-joints. Its rest pose is that of the motion's skeleton put through the same curves and
// Slerps. Sub-joints are named NAME_2, NAME_3, … after their joint.
struct SubSkeleton {
  std::shared_ptr<const Skeleton> skeleton;
  Pose rest;
};
SubSkeleton sub_skeleton(const Motion& motion, const SubJoints& sub, Work& work);

// Sub-joints of groups lie on the curve through the group's joints, or nearer to their straight links where
// it goes over 0.15 of the group's length away from them (never over 0.25); the others on their straight
// links. Then they swing on springs. World orientation of J′_{k,1}: the smallest turn of the input's that
// aims joint k's old link at its first new one; of J′_{k,l}: the Slerp by (l − 1)/m_k from it to the child's,
// both from their rest. `contacts`, where given: a planted point doesn't swing, and the less, the nearer to
// it, do the sub-joints of its limb, so that feet stand still. Sub-joints are named NAME_2, NAME_3, … after
// their joint.
RubberResult rubber_joints(const Motion& motion, const RubberParams& params, const Contacts* contacts,
                           Work& work);

}  // namespace kinegraph
