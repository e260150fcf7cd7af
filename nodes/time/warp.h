// A time warp between two motions: what TimeWarp found and UnwarpTime undoes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "graph/value.h"

namespace kinegraph {

// What linear interpolation misses at a skipped source frame, so that an unchanged motion returns.
struct SkippedFrame {
  std::uint32_t frame = 0;
  double d_x = 0, d_z = 0, d_heading = 0, height = 0;  // per second, m
  // Three a joint: log of the rotation that is missing, on the parent's side; per-dof: what v misses, rad.
  // Then three for each joint other than the root that has a translation track, m. Then, but for per-dof, one
  // a joint: the turn between the shown neighbours, rad, by which an edit's gain is known.
  std::vector<double> logs;
};

class Warp final : public Value {
 public:
  bool identity = true;       // fits any length: rows are frames (the constant of a disabled TimeWarp)
  bool source_warped = true;  // true: the source was laid on the reference's clock (source shorter);
                              // false: the reference on the source's, and UnwarpTime is the identity
  double fps = 120;
  std::uint32_t source_frames = 0, reference_frames = 0;
  // One path for all (shared) or one per DOF (per-dof). Entry r: the frame shown at row r.
  std::vector<std::vector<std::uint32_t>> paths;
  // Names of the paths in per-dof ("LeftUpLeg.x", "root.height"; "*": of every DOF not named); empty when
  // shared.
  std::vector<std::string> dofs;
  std::vector<double>
      means;  // per-dof: x y z w around which v is taken, of each joint of the source (the root's: its rest)
  std::vector<SkippedFrame> skipped;
  std::vector<double> energy;  // after every half-step, the first value first
  int rounds = 0;

  std::string_view type() const override { return "Warp"; }
  std::size_t bytes() const override;
  void encode(Encoder& out) const override;
  std::optional<NonFinite> non_finite() const override;
};
ValuePtr decode_warp(Decoder& in);

}  // namespace kinegraph
