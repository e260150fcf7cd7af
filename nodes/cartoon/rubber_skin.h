// A skinned mesh on the sub-joint skeleton [Kwon §5.5].
#pragma once
#include "graph/work.h"
#include "nodes/cartoon/sub_joints.h"
#include "nodes/motion/character.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// Influences of a vertex that are kept: one set of glTF's, as three.js (r187) and most engines read no more;
// they would weigh what is left anew and put vertices elsewhere. A vertex that is bound to more joints itself
// keeps one of each, so that sums hold.
inline constexpr int usual_influences = 4;

// The character with the links of its joints cut as `of_motion` cuts those of `motion` (joints matched by
// name). The weight of a vertex v on joint k goes to its sub-joints,
//   w'_{v,k,l} = w_{v,k} d_l⁻¹ / Σ d⁻¹,
// d_l the distance at rest, at least 1e-6 of the height, from v to the segment J'_{k,l} – J'_{k,l+1}. Of more
// than usual_influences the smallest are dropped and their weights go to the largest kept one of the same
// joint, so sums hold. At rest every vertex stays where it was: inverse bind matrices are those of the joint,
// seen from the sub-joint's own rest.
Character rubber_character(const Character& character, const Motion& motion, const SubJoints& of_motion,
                           const SubJointParams& params, Work& work);

}  // namespace kinegraph
