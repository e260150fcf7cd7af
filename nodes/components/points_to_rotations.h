// Rotations of a skeleton from positions of its joints, so that edited points become a motion again [Shapiro
// §3.2].
#pragma once
#include <vector>

#include "nodes/components/decomposed_pose.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

class PointsToRotations {
 public:
  // `known`: joints whose positions the points give. `turning`: joints that turn on their own; a link that
  // hangs on a joint only through such a one (a spine that starts in the hips' own place) says nothing about
  // the joint while there are others. The skeleton outlives this.
  PointsToRotations(const Skeleton& skeleton, const std::vector<bool>& known,
                    const std::vector<bool>& turning);

  // World orientations (relative to the frame that the positions stand in) of some frames into `world`.
  // positions: only known joints are read. base: the base motion in that same frame, for the same frames. A
  // joint with two or more links turns by the best rotation of them [Kabsch 1976], one with a single link by
  // the smallest turn of the base's orientation that aims it, the others keep the base's local rotation. A
  // link leads to a known child off the joint; children that sit on the joint itself pass theirs on. Only the
  // links' directions count, so stretched points give the same rotations.
  void frames(const JointPositions& positions, const RootedPoses& base, JointRotations& world) const;

 private:
  struct Aim {
    int target;
    double length;             // of the link at rest
    std::vector<int> through;  // joints between, all at this joint's place
  };
  struct Pairs {  // links at rest, and where they should point
    std::vector<Vec3> from, to;
  };
  Vec3 rest_of(const Aim& aim, const RootedPoses& base, std::size_t t) const;
  // One joint at one frame, whatever it has.
  Quat orientation(int joint, std::size_t t, const JointPositions& positions, const RootedPoses& base,
                   const JointRotations& world, Pairs& pairs) const;
  void collect(int joint, std::vector<int> through, const std::vector<bool>& known,
               std::vector<Aim>& aims) const;

  const Skeleton& skeleton_;
  std::vector<std::vector<Aim>> aims_;
};

// The rotation R that makes Σ ‖R from_i - to_i‖² least [Horn 1987]; `prior` decides what the pairs leave
// open.
Quat best_rotation(const std::vector<Vec3>& from, const std::vector<Vec3>& to, Quat prior);

}  // namespace kinegraph
