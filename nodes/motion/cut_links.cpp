#include "nodes/motion/cut_links.h"

namespace kinegraph {

std::vector<bool> on_cut_links(const Skeleton& skeleton) {
  std::vector<int> children(skeleton.joints.size()), number(skeleton.joints.size(), 1), first;
  for (int j = 1; j < skeleton.size(); ++j) ++children[skeleton.joints[j].parent];
  std::vector<bool> cut(skeleton.joints.size());
  for (int j = 0; j < skeleton.size(); ++j) {
    first.push_back(j);
    const int parent = skeleton.joints[j].parent;
    if (parent < 0 || children[j] != 1) continue;
    std::string expected = skeleton.joints[first[parent]].name + "_" + std::to_string(number[parent] + 1);
    std::string name = skeleton.joints[j].name;
    // RubberJoints adds these where the name is taken.
    while (name.size() > expected.size() && name.back() == '_') name.pop_back();
    if (name != expected) continue;
    cut[j] = true;
    number[j] = number[parent] + 1;
    first[j] = first[parent];
  }
  return cut;
}

int whole_parent(const Skeleton& skeleton, const std::vector<bool>& cut, int joint) {
  int parent = skeleton.joints[joint].parent;
  while (parent >= 0 && cut[parent]) parent = skeleton.joints[parent].parent;
  return parent;
}

}  // namespace kinegraph
