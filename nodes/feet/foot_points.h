// Which points of a skeleton are heels and balls of feet, and how they move.
#pragma once
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// Patterns of joints; "" = found by name, else by the shape of the rest pose: the heel is the ankle joint,
// the ball the toe joint, or the toe's End Site where the foot has no toe joint. Left heel, left ball, right
// heel, right ball; nothing is planted yet. Throws Failure ("no-feet", "unknown-joint").
std::vector<FootPoint> foot_points(const Skeleton& skeleton, const std::string& heels,
                                   const std::string& balls, Work& work);

// World positions over time, metres.
std::vector<Vec3> path_of(const FootPoint& point, const WorldMotion& world);

}  // namespace kinegraph
