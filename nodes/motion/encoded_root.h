// The encoded root [Wu §5.2, Hsu 2005]: heading, travel per frame in the heading's frame, height, and what is
// left of the rotation. Travel and heading differences are per second, so that rates compare.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct EncodedRoot {
  double fps = 120;
  Vec3 start;                     // world position of frame 0, m
  double start_heading = 0;       // ψ_0, rad
  std::vector<double> d_x, d_z;   // travel, m/s; entry t is from t-1 to t; entry 0 repeats entry 1
  std::vector<double> d_heading;  // Δψ, rad/s; likewise
  std::vector<double> height;     // y, m, absolute
  std::vector<double> heading;    // ψ unwrapped, rad: kept beside its differences
  std::vector<Quat> rho;          // world: q = R_y(ψ) ρ, sign-continuous; includes the rest orientation
  std::size_t frames() const { return height.size(); }
};

// ψ = 2 atan2(y, w) of q q_rest⁻¹ in world, unwrapped; where the swing comes within 5° of 180° it is bridged
// linearly and warned about ("heading-singular").
EncodedRoot encode_root(const Motion& motion, Work& work);

// Integrates p_t = p_{t-1} + R_y(ψ_{t-1}) d_t from start and start_heading (ψ from d_heading), and writes the
// root's rotation and translation into `motion`, which has root.frames() frames and a root translation track.
void decode_root(const EncodedRoot& root, Motion& motion);
// As decode_root, with the headings given in root.heading instead of integrated from d_heading.
void decode_root_keeping_heading(const EncodedRoot& root, Motion& motion);

}  // namespace kinegraph
