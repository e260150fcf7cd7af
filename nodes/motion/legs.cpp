// Which joints are the legs, by their names in the conventions that are about, else by the shape of the rest
// pose.
#include <algorithm>
#include <cmath>

#include "nodes/motion/cut_links.h"
#include "nodes/motion/joint_names.h"
#include "nodes/motion/limb_chains.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

namespace {

double world_length(const RestPose& pose, int a, int b) {
  return norm(pose.positions[a] - pose.positions[b]);
}

// The joint after the ankle: named so, else the child with the longest link; -1 where there is none with a
// length. Joints on a cut link are passed by.
int toe_below(const Skeleton& skeleton, const std::vector<bool>& cut, const std::vector<JointName>& meanings,
              const RestPose& pose, int ankle) {
  const auto longest = [&](auto fits) {
    int toe = -1;
    double longest_link = 0;
    for (int j = ankle + 1; j < skeleton.size(); ++j) {
      if (cut[j] || whole_parent(skeleton, cut, j) != ankle || !fits(j)) continue;
      const double length = world_length(pose, j, ankle);
      if (toe >= 0 && !(length > longest_link)) continue;
      toe = j;
      longest_link = length;
    }
    return toe;
  };
  const int named = longest([&](int j) { return meanings[j].part == BodyPart::toe; });
  if (named >= 0) return named;
  return longest([&](int j) { return world_length(pose, j, ankle) > 0; });
}

void add_toe_tip(const Skeleton& skeleton, Leg& leg) {
  int joint = leg.toe >= 0 ? leg.toe : leg.ankle;
  for (const EndSite& end : skeleton.ends)
    if (end.joint == joint && norm(end.offset) > 0 && !leg.toe_tip) leg.toe_tip = end.offset;
}

std::optional<Leg> named_leg(const Skeleton& skeleton, const std::vector<bool>& cut,
                             const std::vector<JointName>& meanings, const RestPose& pose, Side side) {
  for (int ankle = 0; ankle < skeleton.size(); ++ankle) {
    if (cut[ankle] || meanings[ankle].side != side || meanings[ankle].part != BodyPart::foot) continue;
    Leg leg;
    leg.left = side == Side::left;
    leg.ankle = ankle;
    // The topmost of several: upperleg01, upperleg02, lowerleg01, lowerleg02.
    for (int j = skeleton.joints[ankle].parent; j >= 0; j = skeleton.joints[j].parent) {
      if (cut[j] || meanings[j].side != side) continue;
      if (meanings[j].part == BodyPart::shin && leg.hip < 0) leg.knee = j;
      if (meanings[j].part == BodyPart::thigh && leg.knee >= 0) leg.hip = j;
    }
    if (leg.hip < 0 || leg.knee < 0) continue;
    leg.toe = toe_below(skeleton, cut, meanings, pose, ankle);
    return leg;
  }
  return {};
}

// --- by geometry ---

std::optional<Leg> leg_of_chain(const RestPose& pose, const std::vector<bool>& cut, std::vector<int> chain) {
  std::erase_if(chain, [&](int j) { return cut[j]; });
  const std::vector<int> limb = longest_limb(pose, chain);
  if (limb.empty()) return {};
  Leg leg;
  leg.hip = limb[0];
  leg.knee = limb[1];
  leg.ankle = limb[2];
  if (limb.size() > 3) leg.toe = limb[3];
  return leg;
}

std::vector<Leg> legs_by_geometry(const Skeleton& skeleton, const std::vector<bool>& cut,
                                  const RestPose& pose) {
  double height = rest_height(skeleton);
  std::vector<int> leaves;
  for (int j = 0; j < skeleton.size(); ++j)
    if (skeleton.children(j).empty()) leaves.push_back(j);
  std::stable_sort(leaves.begin(), leaves.end(),
                   [&](int a, int b) { return pose.positions[a].y < pose.positions[b].y; });
  // Feet are among the lowest of them; all pairs of ten thousand leaves would take a minute.
  constexpr std::size_t most = 256;
  leaves.resize(std::min(leaves.size(), most));
  // Two leaves in the lowest fifth whose chains part at one joint, reach equally low and are equally long.
  double low = leaves.empty() ? 0 : pose.positions[leaves[0]].y;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    for (std::size_t k = i + 1; k < leaves.size(); ++k) {
      if (pose.positions[leaves[k]].y > low + 0.2 * height) break;
      int top = common_ancestor(skeleton, leaves[i], leaves[k]);
      auto one = leg_of_chain(pose, cut, chain_between(skeleton, top, leaves[i]));
      auto other = leg_of_chain(pose, cut, chain_between(skeleton, top, leaves[k]));
      if (!one || !other) continue;
      double a = world_length(pose, one->hip, one->knee) + world_length(pose, one->knee, one->ankle);
      double b = world_length(pose, other->hip, other->knee) + world_length(pose, other->knee, other->ankle);
      if (std::fabs(a - b) > 0.1 * std::max(a, b)) continue;
      // Left is where up × forward points; forward is where the feet point, else z.
      Vec3 forward;
      for (const Leg& leg : {*one, *other})
        if (leg.toe >= 0) forward += pose.positions[leg.toe] - pose.positions[leg.ankle];
      forward.y = 0;
      if (norm(forward) < 1e-3 * height) forward = {0, 0, 1};
      Vec3 left = cross({0, 1, 0}, forward);
      double side = dot(left, pose.positions[one->hip] - pose.positions[other->hip]);
      if (side == 0) side = dot(left, pose.positions[one->ankle] - pose.positions[other->ankle]);
      if (side < 0) std::swap(*one, *other);
      one->left = true;
      other->left = false;
      return {*one, *other};
    }
  }
  return {};
}

}  // namespace

std::vector<Leg> find_legs(const Skeleton& skeleton) {
  if (skeleton.joints.empty()) return {};
  RestPose pose = rest_pose(skeleton);
  const std::vector<bool> cut = on_cut_links(skeleton);
  std::vector<JointName> meanings;
  for (const Joint& joint : skeleton.joints) meanings.push_back(read_joint_name(joint.name));
  std::vector<Leg> legs;
  for (Side side : {Side::left, Side::right})
    if (auto leg = named_leg(skeleton, cut, meanings, pose, side)) legs.push_back(*leg);
  if (legs.empty()) legs = legs_by_geometry(skeleton, cut, pose);
  for (Leg& leg : legs) add_toe_tip(skeleton, leg);
  return legs;
}

double leg_length(const Skeleton& skeleton) {
  auto legs = find_legs(skeleton);
  double sum = 0;
  for (const Leg& leg : legs)
    for (int j = leg.ankle; j != leg.hip; j = skeleton.joints[j].parent) sum += skeleton.link_length(j);
  return legs.empty() ? 0 : skeleton.above_scale * sum / static_cast<double>(legs.size());
}

}  // namespace kinegraph
