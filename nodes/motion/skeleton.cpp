#include "nodes/motion/skeleton.h"

#include <algorithm>

namespace kinegraph {

int Skeleton::find(std::string_view name) const {
  for (int j = 0; j < size(); ++j)
    if (joints[j].name == name) return j;
  return -1;
}

std::vector<int> Skeleton::children(int joint) const {
  std::vector<int> found;
  for (int j = joint + 1; j < size(); ++j)
    if (joints[j].parent == joint) found.push_back(j);
  return found;
}

bool Skeleton::is_below(int joint, int ancestor) const {
  while (joint > ancestor) joint = joints[joint].parent;  // a parent's index is smaller than its child's
  return joint == ancestor;
}

RestPose rest_pose(const Skeleton& skeleton) {
  RestPose pose;
  for (const Joint& joint : skeleton.joints) {
    Quat above = joint.parent < 0 ? skeleton.above : pose.orientations[joint.parent];
    Vec3 from = joint.parent < 0 ? skeleton.above_offset : pose.positions[joint.parent];
    pose.positions.push_back(from + rotate(above, skeleton.above_scale * joint.offset));
    pose.orientations.push_back(above * joint.rest);
  }
  for (const EndSite& end : skeleton.ends) {
    Vec3 offset = skeleton.above_scale * end.offset;
    pose.ends.push_back(pose.positions[end.joint] + rotate(pose.orientations[end.joint], offset));
  }
  return pose;
}

double rest_height(const Skeleton& skeleton) {
  if (skeleton.joints.empty()) return 0;
  RestPose pose = rest_pose(skeleton);
  double low = pose.positions[0].y, high = low;
  for (const auto* points : {&pose.positions, &pose.ends}) {
    for (Vec3 p : *points) {
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
  }
  return high - low;
}

}  // namespace kinegraph
