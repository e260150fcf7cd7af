// Bounds on how fast orientations turn and twist about their links.
#pragma once
#include <span>
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

// Radians from one frame to the next.
struct TurnLimits {
  double twist = 0;            // or what the input twists there, if that is more
  double twist_departure = 0;  // from what the input twists
  double turn_departure = 0;   // more than that turn of the input, of the rotation between input and result
};
// Of a motion with that many frames a second: 15°, 5° and 30° at 120.
TurnLimits turn_limits(double fps);

// The twist of a rotation about an axis, as cosine and sine of half its angle, the cosine not negative: cheap
// to compare. Lengths don't matter. Without a twist (half a turn about an axis across) both are 0.
struct HalfTwist {
  double cosine = 1, sine = 0;
  HalfTwist(Quat rotation, Vec3 axis);
  explicit HalfTwist(double angle);
  double angle() const;                     // in [−π, π]
  HalfTwist beyond(HalfTwist other) const;  // this one less the other
  bool exceeds(HalfTwist other) const;      // in size
};

// The values nearest to `values` whose steps values[t] − values[t − 1] lie in [least[t], most[t]]: midway
// between the lowest such curve that is nowhere below them and the highest that is nowhere above.
std::vector<double> with_steps_between(std::span<const double> values, std::span<const double> least,
                                       std::span<const double> most);

// The same for rotations that may turn by most[t] from frame t − 1 to t.
std::vector<Quat> with_turns_within(std::span<const Quat> turns, std::span<const double> most);

// Twists `orientations` about `axis`, in their own frame, so that no frame's twist exceeds `limits.twist` or
// that of any of `inputs` about its axis. They stay as they are where nothing does.
struct InputTwist {
  ConstQuatTrack orientation;
  Vec3 axis;
};
void limit_twist(Vec3 axis, std::span<const InputTwist> inputs, const TurnLimits& limits,
                 QuatTrack orientations);

}  // namespace kinegraph
