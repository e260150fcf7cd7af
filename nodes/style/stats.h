// The statistics of a motion that carry its style [Wu §5].
#pragma once
#include <array>
#include <string>
#include <vector>

#include "graph/value.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

struct JointStats {
  std::string joint;
  bool chosen = true;   // false: not in the pattern; only its name and rest stand here
  Quat mean;            // quaternion space; the root's is that of ρ
  double spread = 0;    // σ: root mean square of the half-angle to the mean, rad
  // Euler space: the file's order and each DOF's mean and σ, rad.
  std::string order;
  std::array<double, 3> euler_mean{}, euler_spread{};
};

class Stats final : public Value {
 public:
  std::string space = "quaternion";  // or "euler"
  std::string mean_kind = "karcher"; // or "slerp"
  std::vector<JointStats> joints;    // the motion's, in its order; joints[0] is the root
  // Rest orientations and parents of the skeleton measured, to warn where rest poses differ.
  std::vector<int> parents;
  std::vector<Vec3> offsets;
  std::vector<Quat> rests;
  // Encoded root: d_x, d_z (m/s), height (m), Δψ (rad/s). Mean and σ over t >= 1 (height: all t).
  std::array<double, 4> root_mean{}, root_spread{};
  double leg_length = 0;  // m
  double fps = 120;
  std::uint64_t frames = 0;

  std::string_view type() const override { return "Stats"; }
  std::size_t bytes() const override;
  void encode(Encoder& out) const override;
  std::optional<NonFinite> non_finite() const override;
};
ValuePtr decode_stats(Decoder& in);

}  // namespace kinegraph
