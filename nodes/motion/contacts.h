// When which part of a foot is planted.
#pragma once
#include <string>
#include <vector>

#include "graph/value.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

// A point of a foot: a joint, or a point fixed in its frame (a toe's End Site).
struct FootPoint {
  std::string foot;  // the ankle joint's name
  bool left = true;
  std::string part;  // "heel" or "ball"
  int joint = -1;    // of the motion's skeleton
  std::string joint_name;
  Vec3 local;                 // in the joint's frame, m; zero = the joint itself
  std::vector<bool> planted;  // one flag a frame
  // World height of each plant (each of runs_of(planted)) in the motion it was found in, m: where the ground
  // is there. Empty where that motion is not known.
  std::vector<double> heights;
};

class Contacts final : public Value {
 public:
  double fps = 120;
  std::size_t frames = 0;
  double floor = 0;               // world height, m
  double leg = 0;                 // length of the legs of the skeleton they are of, m; 0 = not known
  std::vector<FootPoint> points;  // left heel, left ball, right heel, right ball

  std::string_view type() const override { return "Contacts"; }
  std::size_t bytes() const override;
  void encode(Encoder& out) const override;
  std::optional<NonFinite> non_finite() const override;
};
ValuePtr decode_contacts(Decoder& in);

// Maximal runs of true: [start, end).
struct Run {
  std::size_t start, end;
};
std::vector<Run> runs_of(const std::vector<bool>& flags);

}  // namespace kinegraph
