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
// name). The weight of a vertex v on joint k goes to the two of its sub-joints that v lies between: with u
// the place of v along k's link at rest, in sub-links and held to [0, m_k − 1],
//   w'_{v,k,l} = w_{v,k} max(0, 1 − |u − (l − 1)|).
// [Kwon §5.5] gives every sub-joint of k its part by inverse distance, up to 16 a vertex; of those the four
// largest are others for each of two neighbours, and the mesh tears between them. Two a joint are seldom over
// four: then the smaller ones of pairs give way to the larger ones, so that sums per joint hold. Vertices of
// four joints or more have room for one sub-joint of each: which one says settle_places(). At rest
// every vertex stays where it was: inverse bind matrices are those of the joint, seen from the sub-joint's
// own rest.
Character rubber_character(const Character& character, const Motion& motion, const SubJoints& of_motion,
                           const SubJointParams& params, Work& work);

}  // namespace kinegraph
