// Reaching a point with two joints of a limb.
#pragma once
#include <optional>

#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct Limb {
  int upper = -1, middle = -1;  // middle is upper's child
};
// The two joints, one the other's parent, that move `joint` best: of its ancestors below the root the pair
// with the longest shorter side, upper to middle and middle to joint. The root itself only where there are no
// others. None: no such pair.
std::optional<Limb> limb_of(const Skeleton& skeleton, int joint);

struct Reached {
  Quat upper, middle;  // new local rotations
  double missing = 0;  // m: how far the goal is out of reach (then nothing is reached)
};
// New local rotations of the limb's joints that bring `joint` to the world position `goal`. `bend`: world
// direction about which a straight limb bends.
Reached reach(const Motion& motion, const Pose& pose, std::size_t frame, const Limb& limb, int joint,
              Vec3 goal, Vec3 bend);

// The direction about which the limb bends over the whole motion, in the upper joint's frame: mean of
// upper-to-middle × middle-to-joint; of a limb that is always straight some direction across it.
Vec3 usual_bend(const Motion& motion, const Limb& limb, int joint);

}  // namespace kinegraph
