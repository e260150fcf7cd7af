// Calms curves and springs for the moments in which they would flip a sub-link round between two frames.
#pragma once
#include <vector>

#include "graph/work.h"
#include "nodes/cartoon/sub_joints.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// Frames at which sub-links turn further from the frame before than 30° (at 120 frames a second), or, where
// the joints' link they are part of does, than twice that, while longer than 20 % of their rest length.
class FlipWatch {
 public:
  // `rubber`: the sub-joint skeleton at rest; `world`: the joints. Both must outlive this.
  FlipWatch(const SubJoints& sub, const Skeleton& rubber, const WorldMotion& world, double fps);
  // Those of the link between sub-joint i and its parent.
  std::vector<std::size_t> flips(const WorldMotion& places, int i) const;

 private:
  double allowed(int i, std::size_t t) const;
  const SubJoints& sub_;
  const WorldMotion& world_;
  std::vector<int> parents_;
  std::vector<double> shortest_squared_;  // below it a link may turn as it likes; negative: not watched
  double most_;
};

// Where a group's curve flips, its sub-joints go for a moment to their straight links: a tight loop lies
// close beside them. Joints stay where they are.
void straighten_flips(const SubJoints& sub, const FlipWatch& watch, const WorldMotion& world, double fps,
                      WorldMotion& places, Work& work);

// Adds swings to `places`: swing[frame * sub-joints + i], of which left[i][frame] is taken (empty: all).
// Where that flips a link, the limb it is in swings less for a moment, down to hanging stiffly on the joint
// it branches off from; a limb that still flips then, together with the one it hangs on.
void add_swings(const SubJoints& sub, const FlipWatch& watch, std::vector<Vec3> swing,
                const std::vector<std::vector<double>>& left, double fps, WorldMotion& places, Work& work);

}  // namespace kinegraph
