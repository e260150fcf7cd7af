#include "nodes/cartoon/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "graph/diagnostic.h"

namespace kinegraph {
namespace {

bool is_small_end(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto has = [&](std::string_view part) { return name.find(part) != std::string::npos; };
  if (has("finger") || has("thumb") || has("pinky") || has("metacarpal")) return true;
  if (has("toe") && (has("end") || has("nub") || has("site"))) return true;
  // Mixamo's LeftHandIndex1, CMU's LeftHandIndex1, index_01_l; not an index of anything else.
  for (auto finger : {"index", "middle", "ring", "little"}) {
    const auto at = name.find(finger);
    if (at == std::string::npos) continue;
    const auto after = at + std::string_view(finger).size();
    const bool ends = after == name.size() || !std::isalpha(static_cast<unsigned char>(name[after])) ||
                      has("hand") || has("prox") || has("dist");
    const bool starts = at == 0 || !std::isalpha(static_cast<unsigned char>(name[at - 1])) || has("hand") ||
                        name.starts_with("l") || name.starts_with("r");
    if (ends && starts) return true;
  }
  return false;
}

int find_joint(const Skeleton& skeleton, const std::string& name, std::size_t group) {
  const int joint = skeleton.find(name);
  if (joint >= 0) return joint;
  std::vector<std::string> names;
  for (const Joint& j : skeleton.joints) names.push_back(j.name);
  throw Failure(error("unknown-joint", fmt::format("there is no joint '{}'", name))
                    .at_param(fmt::format("groups[{}]", group))
                    .hinting(suggestion(name, names)));
}

}  // namespace

std::vector<bool> small_ends(const Skeleton& skeleton) {
  std::vector<bool> small(skeleton.joints.size());
  for (int j = 1; j < skeleton.size(); ++j)
    small[j] = small[skeleton.joints[j].parent] || is_small_end(skeleton.joints[j].name);
  return small;
}

std::vector<std::vector<int>> automatic_groups(const Skeleton& skeleton, const std::vector<bool>& pruned) {
  const std::size_t count = skeleton.joints.size();
  std::vector<int> children(count), only_child(count, -1);
  for (int j = 1; j < skeleton.size(); ++j) {
    if (pruned[j]) continue;
    const int parent = skeleton.joints[j].parent;
    ++children[parent];
    only_child[parent] = j;
  }
  // Parents before children: seen from the end, a child's membership is known before its parent's.
  std::vector<bool> member(count);
  for (int j = skeleton.size() - 1; j >= 0; --j)
    member[j] = !pruned[j] && (children[j] == 0 || (children[j] == 1 && member[only_child[j]]));
  std::vector<std::vector<int>> groups;
  for (int j = 0; j < skeleton.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    if (!member[j] || (parent >= 0 && member[parent])) continue;
    std::vector<int> group{j};
    while (children[group.back()] == 1) group.push_back(only_child[group.back()]);
    groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<std::vector<int>> named_groups(const Skeleton& skeleton,
                                           const std::vector<std::pair<std::string, std::string>>& ends) {
  std::vector<std::vector<int>> groups;
  std::vector<bool> taken(skeleton.joints.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int first = find_joint(skeleton, ends[i].first, i), last = find_joint(skeleton, ends[i].second, i);
    const auto refuse = [&](std::string what, const char* hint) {
      throw Failure(error("bad-group", std::move(what)).at_param(fmt::format("groups[{}]", i)).hinting(hint));
    };
    if (!skeleton.is_below(last, first))
      refuse(fmt::format("{} does not lie below {}", ends[i].second, ends[i].first),
             "name the joint nearer to the root first");
    std::vector<int> group;
    for (int j = last; j != first; j = skeleton.joints[j].parent) group.push_back(j);
    group.push_back(first);
    std::reverse(group.begin(), group.end());
    for (int j : group) {
      if (taken[j])
        refuse(fmt::format("{} is in another group already", skeleton.joints[j].name),
               "let groups share no joint");
      taken[j] = true;
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace kinegraph
