// The measures by which the main job is judged, written apart from the program's own: plain loops over
// frames, the C library's functions, nothing from nodes/style or nodes/judge.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"
#include "nodes/style/stats.h"

namespace kinegraph::independent {

struct Spread {
  Quat mean;
  double sigma = 0;  // rms half-angle, rad
};
// Mean rotation by the chordal mean made into a Karcher mean by plain fixed-point steps.
Spread spread_of(const std::vector<Quat>& rotations);

// ψ of the root in world relative to rest, unwrapped, rad; and ρ = R_y(-ψ) q.
struct Heading {
  std::vector<double> psi;
  std::vector<Quat> rho;
};
Heading heading_of(const Motion& motion);

// Per joint, degrees: √(turn between the means² + (2Δσ)²), over the joints that the Stats name and σ > 0.06°
// in either.
std::map<std::string, double> style_distances(const Motion& motion, const std::vector<JointStats>& wanted);
double mean_of(const std::map<std::string, double>& values);

// World positions of every joint and frame, by plain forward kinematics.
std::vector<std::vector<Vec3>> positions_of(const Motion& motion);
// The farthest, in metres, that a point which should be planted comes from the middle of its plant.
double farthest_from_plants(const Motion& motion, const Contacts& contacts);
// Largest acceleration of each joint after a zero-phase 15 Hz second-order Butterworth low-pass, m/s².
std::map<std::string, double> largest_accelerations(const Motion& motion);

// Joints whose largest acceleration is over twice the larger of those in two inputs and 20 m/s², each with
// the numbers; empty where all is smooth.
std::string joints_that_jerk(const Motion& result, const Motion& one, const Motion& other);

// What a cleanup of the feet adds to a motion more than two frames from a plant of the leg (elsewhere: in any
// frame): second differences of the joints' moves, m/s², the largest over joints and frames.
struct Added {
  double raw = 0;   // of the frames as they are
  double calm = 0;  // after a zero-phase 15 Hz low-pass of the moves
  double own = 0;  // raw, less the part of the clip's jumps that a link which was turned by θ has to repeat:
                   // 2 sin(θ/2) of its own second difference, for each link from the root on
};
Added most_added(const Motion& before, const Motion& after, const Contacts& contacts);

// Degrees by which the line from one joint to another leans forwards of upright, mean over the frames;
// forwards is square to the line from the right hip to the left one.
double mean_pitch(const Motion& motion, const std::string& from, const std::string& to,
                  const std::string& left_hip, const std::string& right_hip);

// Steps, told by the legs alone, so that runs and sneaks count as well: how far the left ankle is ahead of
// the right in the heading's frame, low-passed at 4 Hz and without its mean; every passing from one side to
// the other is a step.
struct Steps {
  int count = 0;
  double cadence = 0;  // steps a second between the first and the last passing
};
Steps steps_of(const Motion& motion, const std::string& left_ankle, const std::string& right_ankle);

}  // namespace kinegraph::independent
