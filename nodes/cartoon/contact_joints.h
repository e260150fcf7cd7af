// Which joints of a motion the points of contacts are on.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// One a point, by name; -1 where the motion lacks the joint, told in one warning ("no-partner"). Throws
// Failure at the port `contacts`: "frames-differ", "rate-mismatch", "no-common-joint" where all are lacking.
std::vector<int> contact_joints(const Contacts& contacts, const Motion& motion, Work& work);

}  // namespace kinegraph
