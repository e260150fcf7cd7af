// How smoothly joints move, and whether bones keep their length.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/judge/measured.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct SmoothnessMeasures {
  Measured jerk;              // mean ‖third difference of the world position‖ × fps³, m/s³
  Measured sparc;             // spectral arc length of the joint's speed (10 Hz, 0.05); its mean over joints
  Measured acceleration_max;  // largest second difference × fps² of the world position, m/s²
  Measured angular_acceleration_max;  // largest change of the local rotation's angular velocity × fps, rad/s²
  Measured bone_drift;                // largest |length/rest − 1| of the link to the parent
};

// The two accelerations are taken after a zero-phase 15 Hz low-pass of the whole motion (captured clips hold
// spikes of 2,000 m/s²); where the rate has no frequencies above 15 Hz, of the motion as it is. Differences
// reach over frames of the window only. Nothing where the window is too short, for sparc of a joint at rest,
// for bone_drift of the root and of links without length.
SmoothnessMeasures measure_smoothness(const Motion& motion, const WorldMotion& world,
                                      const std::vector<bool>& joints, Window window, Work& work);

}  // namespace kinegraph
