#include "nodes/motion/body.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "nodes/motion/joint_names.h"
#include "nodes/motion/limb_chains.h"

namespace kinegraph {

namespace {

using Names = std::vector<JointName>;

// The first joint of a part below `top`; the topmost, as parents come first. -1: none.
int first_below(const Skeleton& skeleton, const Names& names, int top, Side side,
                std::initializer_list<BodyPart> parts) {
  for (int j = top + 1; j < skeleton.size(); ++j) {
    const bool fits = std::find(parts.begin(), parts.end(), names[j].part) != parts.end();
    if (fits && names[j].side == side && skeleton.is_below(j, top)) return j;
  }
  return -1;
}

int first_of(const Names& names, Side side, BodyPart part) {
  for (std::size_t j = 0; j < names.size(); ++j)
    if (names[j].side == side && names[j].part == part) return static_cast<int>(j);
  return -1;
}

std::optional<Arm> named_arm(const Skeleton& skeleton, const Names& names, Side side) {
  Arm arm;
  arm.left = side == Side::left;
  arm.upper = first_of(names, side, BodyPart::upper_arm);
  const bool shoulder_is_arm = arm.upper < 0;
  if (shoulder_is_arm) arm.upper = first_of(names, side, BodyPart::shoulder);
  if (arm.upper < 0) return {};
  arm.forearm = first_below(skeleton, names, arm.upper, side, {BodyPart::forearm});
  if (arm.forearm < 0) return {};
  arm.hand = first_below(skeleton, names, arm.forearm, side, {BodyPart::wrist, BodyPart::hand});
  for (int j = skeleton.joints[arm.upper].parent; j >= 0; j = skeleton.joints[j].parent) {
    const bool is_shoulder = names[j].part == BodyPart::shoulder && !shoulder_is_arm;
    if (names[j].side == side && (names[j].part == BodyPart::clavicle || is_shoulder)) arm.clavicle = j;
  }
  return arm;
}

// --- by geometry ---

// From a joint to the end of the longest way down.
struct Way {
  std::vector<int> joints;  // that joint first
  double length = 0;
};
Way longest_way(const Skeleton& skeleton, const RestPose& pose, int from) {
  Way best;
  for (int child : skeleton.children(from)) {
    Way way = longest_way(skeleton, pose, child);
    way.length += norm(pose.positions[child] - pose.positions[from]);
    if (best.joints.empty() || way.length > best.length) best = std::move(way);
  }
  best.joints.insert(best.joints.begin(), from);
  return best;
}

// From right to left, horizontal, as the legs stand.
Vec3 left_of(const RestPose& pose, const std::vector<Leg>& legs) {
  Vec3 left;
  for (const Leg& leg : legs) left += (leg.left ? 1 : -1) * pose.positions[leg.hip];
  left.y = 0;
  return normalized(left);
}

Arm arm_of_way(const RestPose& pose, const Way& way, bool left) {
  Arm arm;
  arm.left = left;
  const std::vector<int> limb = longest_limb(pose, way.joints);
  if (limb.empty()) return arm;
  arm.upper = limb[0];
  arm.forearm = limb[1];
  arm.hand = limb[2];
  if (arm.upper != way.joints.front()) arm.clavicle = way.joints.front();
  return arm;
}

// Up from the pelvis: where two equally long ways part to the sides, arms begin.
std::vector<Arm> arms_by_geometry(const Skeleton& skeleton, const RestPose& pose,
                                  const std::vector<Leg>& legs) {
  if (legs.size() != 2) return {};
  const Vec3 left = left_of(pose, legs);
  int at = common_ancestor(skeleton, legs[0].hip, legs[1].hip);
  const auto is_leg = [&](int j) {
    return skeleton.is_below(legs[0].hip, j) || skeleton.is_below(legs[1].hip, j);
  };
  const auto beside = [&](const Way& way) {
    return dot(pose.positions[way.joints.back()] - pose.positions[at], left);
  };
  while (true) {
    std::vector<Way> ways;
    for (int child : skeleton.children(at)) {
      if (is_leg(child)) continue;
      ways.push_back(longest_way(skeleton, pose, child));
      ways.back().length += norm(pose.positions[child] - pose.positions[at]);
    }
    if (ways.empty()) return {};
    for (const Way& a : ways)
      for (const Way& b : ways) {
        const bool sides = beside(a) > 0.3 * a.length && beside(b) < -0.3 * b.length;
        if (!sides || std::fabs(a.length - b.length) > 0.1 * a.length) continue;
        const Arm one = arm_of_way(pose, a, true), other = arm_of_way(pose, b, false);
        if (one.upper >= 0 && other.upper >= 0) return {one, other};
      }
    at = std::max_element(ways.begin(), ways.end(), [](const Way& a, const Way& b) {
           return a.length < b.length;
         })->joints.front();
  }
}

// The end of what rises highest above the chest beside the arms.
int head_by_geometry(const Skeleton& skeleton, const RestPose& pose, const Body& body, int chest) {
  int head = -1;
  for (int j = chest + 1; j < skeleton.size(); ++j) {
    if (!skeleton.is_below(j, chest)) continue;
    const bool of_arm = std::any_of(body.arms.begin(), body.arms.end(), [&](const Arm& arm) {
      return skeleton.is_below(j, arm.clavicle >= 0 ? arm.clavicle : arm.upper);
    });
    if (!of_arm && (head < 0 || pose.positions[j].y > pose.positions[head].y)) head = j;
  }
  return head;
}

}  // namespace

Body find_body(const Skeleton& skeleton) {
  Body body;
  if (skeleton.joints.empty()) return body;
  Names names;
  for (const Joint& joint : skeleton.joints) names.push_back(read_joint_name(joint.name));
  const RestPose pose = rest_pose(skeleton);
  body.legs = find_legs(skeleton);
  for (Side side : {Side::left, Side::right})
    if (auto arm = named_arm(skeleton, names, side)) body.arms.push_back(*arm);
  if (body.arms.empty()) body.arms = arms_by_geometry(skeleton, pose, body.legs);
  body.head = first_of(names, Side::middle, BodyPart::head);

  int chest = -1;
  for (const Arm& arm : body.arms) {
    // The arm's first joint itself is not the chest.
    const int above = skeleton.joints[arm.clavicle >= 0 ? arm.clavicle : arm.upper].parent;
    if (above >= 0) chest = chest < 0 ? above : common_ancestor(skeleton, chest, above);
  }
  if (body.head < 0 && chest >= 0) body.head = head_by_geometry(skeleton, pose, body, chest);
  const int top = chest >= 0 ? chest : body.head;
  if (body.legs.empty() && top < 0) return body;
  for (const Leg& leg : body.legs) {
    const int above = std::max(skeleton.joints[leg.hip].parent, 0);
    body.pelvis = body.pelvis < 0 ? above : common_ancestor(skeleton, body.pelvis, above);
  }
  if (body.pelvis >= 0 && top >= 0) body.pelvis = common_ancestor(skeleton, body.pelvis, top);
  if (body.pelvis < 0) body.pelvis = std::max(first_of(names, Side::middle, BodyPart::pelvis), 0);
  if (top < 0 || !skeleton.is_below(top, body.pelvis)) return body;

  body.spine = chain_between(skeleton, body.pelvis, top);
  if (body.head == top) body.spine.pop_back();
  if (chest < 0) {
    const auto neck = std::find_if(body.spine.begin(), body.spine.end(),
                                   [&](int j) { return names[j].part == BodyPart::neck; });
    body.neck.assign(neck, body.spine.end());
    body.spine.erase(neck, body.spine.end());
  } else if (body.head >= 0 && body.head != chest && skeleton.is_below(body.head, chest)) {
    body.neck = chain_between(skeleton, chest, body.head);
    body.neck.pop_back();
  }
  return body;
}

}  // namespace kinegraph
