// All metrics of a motion, alone and against a reference.
#pragma once
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/judge/measured.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/metrics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct MeasureParams {
  std::vector<bool> joints;      // of the motion; empty = all
  Window window;                 // frames of the motion; end 0 = to the end
  std::vector<std::string> map;  // "FROM=TO": FROM of the reference, TO of the motion
};

// skate, skate_share, penetration, jerk, sparc, acceleration_max, angular_acceleration_max, bone_drift,
// position_distance, rotation_distance, aligned_distance, style_distance, in this order and always all of
// them; then each of them for each joint asked for as NAME.JOINT (the first three only for joints that carry
// a point of a foot). Whatever can't be had is null. The window cuts the motion; distances frame by frame
// take the same frames of the reference, the other two all of it. `reference` and `contacts` may be null;
// contacts are then found with DetectContacts' defaults. Throws Failure: "rate-mismatch", "length-mismatch"
// (contacts of another number of frames), "unknown-joint", "bad-map".
Metrics measure(const Motion& motion, const Motion* reference, const Contacts* contacts,
                const MeasureParams& params, Work& work);

}  // namespace kinegraph
