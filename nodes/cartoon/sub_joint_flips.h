// Finds sub-links that flip round between two frames, and takes that out of curves.
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
  bool watches(int i) const { return shortest_squared_[i] >= 0; }
  double rest_length(int i) const { return rest_[i]; }
  double height() const { return height_; }  // at rest
  // Radians that it may turn from frame t − 1 to t, and what it may at least in every frame.
  double allowed(int i, std::size_t t) const;
  double always_allowed() const { return most_; }

 private:
  const SubJoints& sub_;
  const WorldMotion& world_;
  std::vector<int> parents_;
  double height_ = 0;
  std::vector<double> rest_;              // lengths
  std::vector<double> shortest_squared_;  // below it a link may turn as it likes; negative: not watched
  double most_, cosine_squared_;          // of most_; over 1: where that is over a right angle
};

// Where a group's curve flips, its sub-joints go for a moment to their straight links: a tight loop lies
// close beside them. Joints stay where they are.
void straighten_flips(const SubJoints& sub, const FlipWatch& watch, const WorldMotion& world, double fps,
                      WorldMotion& places, Work& work);

}  // namespace kinegraph
