// How two motions differ, joint by joint: what `kinegraph compare` tells.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/metrics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct JointDifference {
  std::string joint;                                   // of a
  std::string other;                                   // its partner in b
  double position_mean = 0, position_max = 0;          // ‖p_a − p_b‖ in world, m
  double rotation_mean = 0, rotation_max = 0;          // turn between the local rotations, degrees
  std::size_t position_frame = 0, rotation_frame = 0;  // of the largest
  double offset = 0;                                   // between the rest offsets, m
};
struct Comparison {
  std::size_t frames_a = 0, frames_b = 0;
  double fps_a = 0, fps_b = 0;
  std::size_t compared = 0;                 // frames looked at, from 0: those that both have
  std::vector<JointDifference> joints;      // in a's order
  std::vector<std::string> only_a, only_b;  // joints without a partner
  double position_mean = 0, position_max = 0, rotation_mean = 0, rotation_max = 0;  // over all joints

  // Same joints by name, frames, rate and rest offsets, and every position and rotation equal to the last
  // bit.
  bool identical = false;
};

// Frame t of a against frame t of b, whatever their rates. Throws Failure ("unknown-joint", "bad-map").
Comparison compare_motions(const Motion& a, const Motion& b, const std::vector<std::string>& map, Work& work);

// The comparison as metrics, for rules: difference.position_mean, .position_max, .rotation_mean,
// .rotation_max, .frames (frames_b − frames_a), .fps (likewise), .joints (joints without a partner); and the
// first four for each joint. Null where no joint or frame was compared.
Metrics metrics_of(const Comparison& comparison);

}  // namespace kinegraph
