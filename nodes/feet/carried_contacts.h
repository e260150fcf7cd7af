// Contacts that were found on one body, for the same motion on another.
#pragma once
#include "graph/work.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The contacts as they are where they fit the motion's skeleton: its ankles' names and the length of its
// legs. Else the planted frames of each side's heel and ball go to the motion's own ("contacts-carried", an
// info). The ground under a plant is then where such points usually stand in their planted frames, as much
// higher or lower as the plant was among its like. Contacts of another length are passed on as they are;
// throws Failure
// ("no-feet").
Contacts carried_contacts(const Contacts& contacts, const Motion& motion, Work& work);

}  // namespace kinegraph
