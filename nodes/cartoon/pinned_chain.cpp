#include "nodes/cartoon/pinned_chain.h"

#include <algorithm>

#include "nodes/cartoon/chain_bend.h"
#include "nodes/cartoon/link_turns.h"

namespace kinegraph {

std::vector<bool> chain_ends(const Skeleton& skeleton, const std::vector<bool>& pruned,
                             const std::set<int>& pinned) {
  std::vector<int> children(skeleton.joints.size()), pinned_ways(skeleton.joints.size());
  std::vector<bool> leads(skeleton.joints.size());
  for (int j = skeleton.size() - 1; j > 0; --j) {
    const int parent = skeleton.joints[j].parent;
    leads[j] = leads[j] || pinned.contains(j);
    if (!pruned[j]) ++children[parent];
    if (!leads[j]) continue;
    leads[parent] = true;
    ++pinned_ways[parent];
  }
  std::vector<bool> out;
  for (int j = 0; j < skeleton.size(); ++j) out.push_back(children[j] > 1 || pinned_ways[j] > 1);
  return out;
}

std::vector<int> chain_to(const Skeleton& skeleton, int joint, const std::vector<bool>& ends) {
  std::vector<int> chain{joint};
  for (int p = skeleton.joints[joint].parent; p >= 0 && !ends[p]; p = skeleton.joints[p].parent)
    chain.push_back(p);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

void bend(const Skeleton& skeleton, const PinnedChain& chain, WorldMotion& moved, const TurnLimits& limits,
          Work& work) {
  const WorldMotion world = moved;
  const std::size_t frames = world.frames();
  // What hangs on the chain rides with its joint.
  std::vector<std::pair<int, std::size_t>> riders;
  for (int j = chain.joints.front(); j < skeleton.size(); ++j) {
    if (!skeleton.is_below(j, chain.joints.front())) continue;
    int on = j;
    auto at = std::find(chain.joints.begin(), chain.joints.end(), on);
    while (at == chain.joints.end()) {
      on = skeleton.joints[on].parent;
      at = std::find(chain.joints.begin(), chain.joints.end(), on);
    }
    riders.emplace_back(j, static_cast<std::size_t>(at - chain.joints.begin()));
  }
  std::vector<double> places{0};
  for (std::size_t i = 1; i < chain.joints.size(); ++i)
    places.push_back(places.back() + std::max(skeleton.link_length(chain.joints[i]), 1e-9));
  // Every set of pins that may hold at once has its curve; between them the parts blend.
  const std::size_t sets = std::size_t{1} << chain.goals.size();
  std::vector<std::vector<std::vector<double>>> curves(sets);
  for (std::size_t set = 1; set < sets; ++set) {
    std::vector<double> given;
    for (std::size_t g = 0; g < chain.goals.size(); ++g)
      if (set >> g & 1) given.push_back(places[chain.goals[g].first]);
    curves[set] = bend_weights(given, places);
  }
  for (std::size_t t = 0; t < frames; ++t) {
    if (t % 256 == 0) work.check();
    std::vector<Vec3> shift(chain.joints.size()), now;
    for (std::size_t set = 1; set < sets; ++set) {
      double part = 1;
      for (std::size_t g = 0; g < chain.goals.size(); ++g)
        part *= set >> g & 1 ? chain.goals[g].second.part[t] : 1 - chain.goals[g].second.part[t];
      if (part == 0) continue;
      if (now.empty())
        for (int joint : chain.joints) now.push_back(world.position(joint)[t]);
      std::vector<std::size_t> given;
      std::vector<Vec3> targets;
      for (std::size_t g = 0; g < chain.goals.size(); ++g) {
        if (!(set >> g & 1)) continue;
        given.push_back(chain.goals[g].first);
        targets.push_back(chain.goals[g].second.target[t]);
      }
      const std::vector<Vec3> bent = bent_chain(now, places, curves[set], given, targets);
      for (std::size_t i = 1; i < shift.size(); ++i) shift[i] += part * (bent[i] - now[i]);
    }
    for (const auto& [j, on] : riders) moved.position(j).set(t, world.position(j)[t] + shift[on]);
  }
  const RestPose rest = rest_pose(skeleton);
  for (std::size_t i = 0; i + 1 < chain.joints.size(); ++i) {
    const int j = chain.joints[i], next = chain.joints[i + 1];
    aim_link(rest_link(rest, j, j, next), world.position(j), world.position(next),
             std::as_const(moved).position(j), std::as_const(moved).position(next), world.orientation(j),
             limits, moved.orientation(j));
    // A pinned joint keeps its orientation, also where the chain goes on to another.
    for (const auto& [index, goal] : chain.goals) {
      if (index != i) continue;
      const auto turned = moved.orientation(j);
      for (std::size_t t = 0; t < frames; ++t)
        turned.set(t, normalized(slerp(goal.part[t], turned[t], world.orientation(j)[t])));
      make_continuous(turned.x, turned.y, turned.z, turned.w);
    }
  }
}

}  // namespace kinegraph
