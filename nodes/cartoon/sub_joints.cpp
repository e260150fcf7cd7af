#include "nodes/cartoon/sub_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/cartoon/groups.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {
namespace {

// A sub-link of 4.25 % of the height, 7.4 cm on a grown-up: five or six on a thigh and a shin, four and three
// on an arm, two on a foot. Chosen as the middle of what gives Kwon and Lee's 58 on 23 joints.
constexpr double sub_link = 0.0425;
constexpr int most_by_length = 12;

// A joint nearer than this to the branching joint above it stands for a part of the trunk.
constexpr double same_place = 0.005;  // of the height

// Standing people are 1.17 to 1.39 times as tall as their longest way from the pelvis to a tip. A rest pose
// that is folded or lies down is lower.
constexpr double least_height = 1.15;

std::vector<double> lengths_of(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  std::vector<double> lengths(skeleton.joints.size());
  double total = 0;
  for (int j = 1; j < skeleton.size(); ++j)
    total += lengths[j] = skeleton.link_length(j) * skeleton.above_scale;
  if (total > 0 || motion.frames() == 0) return lengths;
  for (int j = 1; j < skeleton.size(); ++j)
    lengths[j] = norm(motion.local_offset(j, 0)) * skeleton.above_scale;
  return lengths;
}

// How tall the body stands: its rest pose's height, or, where that is folded, by its longest way from the
// first branching joint to a tip.
double height_of(const Skeleton& skeleton, const std::vector<double>& lengths) {
  std::vector<int> children(skeleton.joints.size());
  for (int j = 1; j < skeleton.size(); ++j) ++children[skeleton.joints[j].parent];
  int trunk = 0;
  while (trunk + 1 < skeleton.size() && children[trunk] == 1) ++trunk;
  if (children[trunk] < 2) trunk = 0;
  std::vector<double> way(skeleton.joints.size());
  double longest = 0;
  for (int j = trunk + 1; j < skeleton.size(); ++j) {
    if (!skeleton.is_below(j, trunk)) continue;
    way[j] = way[skeleton.joints[j].parent] + lengths[j];
    longest = std::max(longest, way[j]);
  }
  return std::max(rest_height(skeleton), least_height * longest);
}

// The only child that isn't pruned, or -1.
std::vector<int> only_children(const Skeleton& skeleton, const std::vector<bool>& pruned) {
  std::vector<int> children(skeleton.joints.size()), only(skeleton.joints.size(), -1);
  for (int j = 1; j < skeleton.size(); ++j) {
    if (pruned[j]) continue;
    ++children[skeleton.joints[j].parent];
    only[skeleton.joints[j].parent] = j;
  }
  for (int j = 0; j < skeleton.size(); ++j)
    if (children[j] != 1 || pruned[j]) only[j] = -1;
  return only;
}

// Joints from the root to the first branching one, such as a root on the ground: they place the body. None
// where the root itself is in a group.
std::vector<bool> placing_joints(const Skeleton& skeleton, const std::vector<int>& only,
                                 const std::vector<std::vector<int>>& groups) {
  std::vector<bool> placing(skeleton.joints.size());
  for (const auto& group : groups)
    if (group.front() == 0) return placing;
  for (int j = 0; only[j] >= 0; j = only[j]) placing[j] = true;
  return placing;
}

std::vector<int> counts_of(const Motion& motion, const SubJointParams& params, const std::vector<int>& only,
                           const std::vector<std::vector<int>>& groups, const std::vector<double>& lengths,
                           Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  const double height = height_of(skeleton, lengths);
  const std::vector<bool> placing = placing_joints(skeleton, only, groups);
  const auto in_trunk = [&](int j) {
    const int parent = skeleton.joints[j].parent;
    return placing[j] || (parent >= 0 && only[parent] < 0 && lengths[j] < same_place * height);
  };
  std::vector<std::string> patterns;
  for (const auto& [pattern, count] : params.counts) patterns.push_back(pattern);
  const std::vector<int> chosen = most_specific(patterns, skeleton, "sub_joints", work);
  std::vector<int> counts(skeleton.joints.size(), 1);
  if (!params.of_each.empty()) {
    for (int j = 0; j < skeleton.size(); ++j)
      if (only[j] >= 0) counts[j] = params.of_each[j];
    return counts;
  }
  for (int j = 0; j < skeleton.size(); ++j) {
    if (chosen[j] >= 0) {
      const auto& [pattern, count] = params.counts[chosen[j]];
      if (only[j] >= 0)
        counts[j] = count;
      else if (count > 1 && pattern == skeleton.joints[j].name)
        throw Failure(
            error("bad-value", fmt::format("{} has no single child, so its link can't be cut", pattern))
                .at_param("sub_joints")
                .at_joint(pattern)
                .hinting("leave it at 1"));
    } else if (only[j] >= 0 && height > 0 && !in_trunk(j)) {
      counts[j] = std::clamp(static_cast<int>(std::floor(lengths[only[j]] / (sub_link * height) + 0.5)), 1,
                             most_by_length);
    }
  }
  return counts;
}

// Places of the sub-joints of one group's links.
void place_on_curve(SubJoints& sub, const std::vector<int>& group, const std::vector<double>& lengths) {
  std::vector<double> links;
  std::vector<CurvePoint> points;
  std::vector<int> whose;
  for (std::size_t i = 0; i + 1 < group.size(); ++i) {
    links.push_back(lengths[group[i + 1]]);
    const int first = sub.first[group[i]];
    for (int l = 1; l < sub.all[first].count; ++l) {
      points.push_back({i, sub.all[first + l].part()});
      whose.push_back(first + l);
    }
  }
  const CurveWeights curve = curve_weights(links, points);
  for (std::size_t p = 0; p < whose.size(); ++p) {
    auto& weights = sub.weights[whose[p]];
    weights.clear();
    for (std::size_t i = 0; i < curve.joints; ++i)
      if (const double w = curve.rows[p * curve.joints + i]; w != 0) weights.emplace_back(group[i], w);
  }
}

}  // namespace

SubJoints lay_sub_joints(const Motion& motion, const SubJointParams& params, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  std::vector<bool> pruned =
      params.prune.empty() ? small_ends(skeleton) : chosen_joints(params.prune, skeleton, "prune", work);
  for (int j = 1; j < skeleton.size(); ++j) pruned[j] = pruned[j] || pruned[skeleton.joints[j].parent];
  std::vector<int> only = only_children(skeleton, pruned);
  SubJoints sub;
  sub.groups =
      params.groups.empty() ? automatic_groups(skeleton, pruned) : named_groups(skeleton, params.groups);
  // A named chain may run through a branch: there its own next joint is the one that counts.
  for (const auto& group : sub.groups)
    for (std::size_t i = 0; i + 1 < group.size(); ++i) only[group[i]] = group[i + 1];
  const std::vector<double> lengths = lengths_of(motion);
  const std::vector<int> counts = counts_of(motion, params, only, sub.groups, lengths, work);

  for (int j = 0; j < skeleton.size(); ++j) {
    const int above = skeleton.joints[j].parent;
    sub.first.push_back(static_cast<int>(sub.all.size()));
    for (int step = 0; step < counts[j]; ++step) {
      SubJoint one{j, step, counts[j], counts[j] > 1 ? only[j] : -1, -1};
      if (step > 0)
        one.parent = static_cast<int>(sub.all.size()) - 1;
      else if (above >= 0)
        one.parent = sub.first[above] + (only[above] == j ? counts[above] - 1 : 0);
      sub.all.push_back(one);
      // On the straight link, unless a group's curve says otherwise.
      sub.weights.push_back({{j, 1 - one.part()}});
      if (step > 0) sub.weights.back().emplace_back(only[j], one.part());
    }
  }
  for (const auto& group : sub.groups) place_on_curve(sub, group, lengths);
  return sub;
}

}  // namespace kinegraph
