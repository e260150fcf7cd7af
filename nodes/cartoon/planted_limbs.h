// How much of the springs' swing sub-joints keep while their limb stands on the floor.
#pragma once
#include <vector>

#include "nodes/cartoon/sub_joints.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// For each sub-joint a series of factors, empty = 1 throughout: 0 at and below a planted joint, growing to 1
// at the upper end of its group, and in time over 0.12 s before and after each plant (C²). `joints`:
// contact_joints().
std::vector<std::vector<double>> swing_left(const Motion& motion, const SubJoints& sub,
                                            const Contacts& contacts, const std::vector<int>& joints);

// 6 u⁵ − 15 u⁴ + 10 u³, held at 0 and 1 outside [0, 1].
double smoothest_step(double u);
// 1 in the frames of `flags`, fading to 0 over `fade` frames before and after each run of them. Between two
// runs that are nearer than that the fades are as long as the gap.
std::vector<double> faded(const std::vector<bool>& flags, double fade);

}  // namespace kinegraph
