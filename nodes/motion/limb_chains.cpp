#include "nodes/motion/limb_chains.h"

#include <algorithm>

namespace kinegraph {

std::vector<int> chain_between(const Skeleton& skeleton, int top, int bottom) {
  std::vector<int> chain;
  for (int j = bottom; j != top; j = skeleton.joints[j].parent) chain.push_back(j);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

int common_ancestor(const Skeleton& skeleton, int a, int b) {
  while (a != b) (a > b ? a : b) = skeleton.joints[std::max(a, b)].parent;
  return a;
}

std::vector<int> longest_limb(const RestPose& pose, const std::vector<int>& chain) {
  const auto length = [&](int a, int b) { return norm(pose.positions[a] - pose.positions[b]); };
  std::vector<int> bends;
  for (int j : chain)
    if (bends.empty() || length(j, bends.back()) > 0) bends.push_back(j);
  if (bends.size() < 3) return {};
  std::size_t best = 0;
  double longest = -1;
  for (std::size_t i = 0; i + 2 < bends.size(); ++i) {
    const double both = length(bends[i], bends[i + 1]) + length(bends[i + 1], bends[i + 2]);
    if (both > longest) {
      longest = both;
      best = i;
    }
  }
  const auto first = bends.begin() + static_cast<std::ptrdiff_t>(best);
  return {first, bends.size() > best + 3 ? first + 4 : bends.end()};
}

}  // namespace kinegraph
