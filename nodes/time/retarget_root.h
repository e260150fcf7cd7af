// Where a retargeted body is, once its joints are turned.
#pragma once
#include <optional>

#include "graph/work.h"
#include "nodes/motion/kinematics.h"
#include "nodes/time/joint_pairs.h"
#include "nodes/time/standing_pose.h"

namespace kinegraph {

struct RootSource {
  const Skeleton* skeleton;
  const WorldMotion* world;
  const StandingPose* stands;
};
struct RootTarget {
  const Skeleton* skeleton;
  const StandingPose* stands;
  std::optional<double> sole;  // world height of a mesh's lowest point as it stands
};

struct PlacedRoot {
  double scale = 1;   // `asked`, or for 0 the quotient of the legs' lengths, else of the heights
  double ground = 0;  // world height that the target stands on
};

// Moves root and pelvis of `motion`, whose joints have their rotations and whose tracks of both translate.
// The middle of the hips goes the source's way from the source's first place, times the scale. Its height is
// the mean of what heels and balls need to stand `scale` times as high above their usual low as the source's
// do, weighted by how low they are; far from the ground the source's own height counts.
PlacedRoot place_root(const RootSource& source, const RootTarget& target, const JointPairs& pairs,
                      double asked, Motion& motion, Work& work);

}  // namespace kinegraph
