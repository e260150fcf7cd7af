#include "nodes/cartoon/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "graph/diagnostic.h"

namespace kinegraph {
namespace {

std::string lower(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

bool is_small_end(const std::string& name) {
  const auto has = [&](std::string_view part) { return name.find(part) != std::string::npos; };
  if (has("finger") || has("thumb") || has("pinky") || has("metacarpal") || has("metatarsal")) return true;
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

// "rMid1", "CC_Base_L_Mid1": a middle finger beside other fingers, the middle of something elsewhere.
bool is_middle(const std::string& name) {
  const auto at = name.find("mid");
  return at != std::string::npos && at + 3 < name.size() &&
         std::isdigit(static_cast<unsigned char>(name[at + 3]));
}

// Bones beside a limb's own that share its twist or the skin of its bend: "CC_Base_L_CalfTwist01",
// "CC_Base_L_KneeShareBone", "upperarm_twist_01_l", "LeftForeArmRoll".
bool is_beside(const std::string& name) {
  return name.find("twist") != std::string::npos || name.find("sharebone") != std::string::npos ||
         name.ends_with("roll");
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
  const std::size_t count = skeleton.joints.size();
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(lower(joint.name));
  // A twist bone that leads on to others, as a neck's does, is of the limb itself.
  std::vector<bool> small(count), beside(count, true);
  for (int j = skeleton.size() - 1; j > 0; --j) {
    beside[j] = beside[j] && is_beside(names[j]);
    if (!beside[j]) beside[skeleton.joints[j].parent] = false;
  }
  std::vector<int> fingers(count), toes(count);
  for (int j = 1; j < skeleton.size(); ++j) {
    if (beside[j]) continue;
    fingers[skeleton.joints[j].parent] += is_small_end(names[j]);
    toes[skeleton.joints[j].parent] += names[j].find("toe") != std::string::npos;
  }
  for (int j = 1; j < skeleton.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    small[j] = small[parent] || beside[j] || is_small_end(names[j]) ||
               (fingers[parent] > 0 && is_middle(names[j])) ||
               (toes[parent] > 1 && names[j].find("toe") != std::string::npos);
  }
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
