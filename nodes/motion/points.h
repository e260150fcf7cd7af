// Labelled points over time: markers, faces, particles, or a motion's joints. World metres, Y up.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "graph/value.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

class Points final : public Value {
 public:
  Points() = default;
  Points(std::vector<std::string> names, double rate, std::size_t frame_count);

  std::vector<std::string> labels;
  double fps = 120;
  std::size_t frames = 0;
  double unit = 1;  // metres per unit of the file it came from
  std::string unit_name = "m";
  UpAxis up = UpAxis::y;
  std::vector<std::pair<int, int>> links;  // to draw; may be empty
  std::vector<double> data;                // per label x, then y, then z, each `frames` long; 0 where missing
  std::vector<bool> missing;               // label * frames + frame; empty = none missing

  ConstVec3Track track(int label) const;
  Vec3Track track(int label);
  bool is_missing(int label, std::size_t frame) const {
    return !missing.empty() && missing[static_cast<std::size_t>(label) * frames + frame];
  }
  void set_missing(int label, std::size_t frame);

  std::string_view type() const override { return "Points"; }
  std::size_t bytes() const override;
  void encode(Encoder& out) const override;
  std::optional<NonFinite> non_finite() const override;
};
ValuePtr decode_points(Decoder& in);
// A motion's joint positions (no End Sites), linked child to parent.
ValuePtr points_of_motion(const Value& motion);

}  // namespace kinegraph
