// A joint's rotation as the file's own Euler angles, for the linear transfer that quaternions replace [Wu
// §5.1, Fig. 2].
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

// "ZYX" and the like: the order of the rotation channels in the motion's BVH; axes that it lacks follow in
// the order Z, Y, X. ZYX where the source is no BVH or repeats an axis.
std::string euler_order_of(const Motion& motion, int joint);

// Three angles a frame, rad, unwrapped: each frame the solution nearest to the one before, the first nearest
// to zero.
std::array<std::vector<double>, 3> euler_channels(const ConstQuatTrack& rotations, std::string_view order);

}  // namespace kinegraph
