// A motion on another skeleton [Wu §8, Cao §5.2]: other names, proportions, rest pose and local axes.
//
// Both skeletons stand upright once (standing_pose.h), turned to face alike. From there a joint's orientation
// in the world changes as its partner's does,
//   O_t = O_s S_s⁻¹ C A S_t,
// S the orientations in the standing poses, A the turn about up from the target's facing to the source's, C
// what brings the target's link, there, to the direction of the source's: along a limb the smallest turn from
// where the joint above has it already, so that no twist comes in. So links point where the source's do, and
// turns about their own axes are the source's.
//
// Links that are the shape of a body rather than its pose are not aligned: a joint with several, as pelvis
// and chest have, holds them at fixed angles to each other, and turns as its partner does; the pelvis after a
// small turn where that brings all of its links within 5°. Feet are aligned
// by their soles: C turns about up only, as the angle from ankle to toe depends on how high the ankle stands.
// Where points of a mesh would be under the ground, toes and feet are bent up by the least that keeps them on
// it. Or, where that is asked for, feet are links as those of limbs, and point where the source's do.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"
#include "nodes/time/joint_pairs.h"
#include "nodes/time/retarget_links.h"
#include "nodes/time/retarget_soles.h"

namespace kinegraph {

struct RetargetParams {
  std::vector<std::string> map;   // as pair_joints
  double scale = 0;               // of travel and height; 0 = by the length of the legs
  FeetBy feet_by = FeetBy::sole;  // where a foot has no toe joint on either side, its sole counts
};

struct RetargetTarget {
  const Motion* motion;         // whose skeleton; its frames, if any, only where its rest pose shows no body
  std::optional<double> sole;   // world height of the lowest point of a mesh on it, in the rest pose; m
  std::vector<SolePoint> feet;  // of that mesh
};

struct RetargetResult {
  Motion motion;  // the target's skeleton and layout, the source's frames and rate
  double scale = 1;
  JointPairs pairs;
  // The link that each joint of the target turns as its partner does: to this joint; -1 = none is aligned.
  std::vector<int> link_to;
};

// The pelvis' path is the source's, times the scale, from the same place; its height is what puts feet at
// `scale` times the source's clearances. Where the target's root is not the pelvis, the root goes below it on
// the ground and heads where it does. Joints without partners stay as the target stands. Throws Failure as
// pair_joints. Warns as pair_joints; "not-upright". Info: "shape-kept", naming links that aren't
// aligned and differ by over 5° as the bodies stand.
RetargetResult retarget(const Motion& motion, const RetargetTarget& target, const RetargetParams& params,
                        Work& work);

}  // namespace kinegraph
