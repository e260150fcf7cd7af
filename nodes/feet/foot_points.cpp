#include "nodes/feet/foot_points.h"

#include <algorithm>

#include "graph/diagnostic.h"
#include "nodes/motion/joint_pattern.h"

namespace kinegraph {
namespace {

FootPoint point_of(const Skeleton& skeleton, const Leg& leg, std::string part, int joint, Vec3 local) {
  FootPoint point;
  point.foot = skeleton.joints[leg.ankle].name;
  point.left = leg.left;
  point.part = std::move(part);
  point.joint = joint;
  point.joint_name = skeleton.joints[joint].name;
  point.local = local;
  return point;
}

void add_found(const Skeleton& skeleton, const Leg& leg, const std::string& part,
               std::vector<FootPoint>& points) {
  if (part == "heel") {
    points.push_back(point_of(skeleton, leg, part, leg.ankle, {}));
  } else if (leg.toe >= 0) {
    points.push_back(point_of(skeleton, leg, part, leg.toe, {}));
  } else if (leg.toe_tip) {
    points.push_back(point_of(skeleton, leg, part, leg.ankle, *leg.toe_tip));
  }
}

// Joints that a pattern names belong to the leg whose ankle they are or hang below.
void add_chosen(const Skeleton& skeleton, const Leg& leg, const std::string& part,
                const std::vector<bool>& chosen, std::vector<FootPoint>& points) {
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (chosen[joint] && skeleton.is_below(joint, leg.ankle))
      points.push_back(point_of(skeleton, leg, part, joint, {}));
}

}  // namespace

std::vector<FootPoint> foot_points(const Skeleton& skeleton, const std::string& heels,
                                   const std::string& balls, Work& work) {
  const std::vector<Leg> legs = find_legs(skeleton);
  std::vector<bool> heel_joints, ball_joints;
  if (!heels.empty()) heel_joints = chosen_joints(heels, skeleton, "heels", work);
  if (!balls.empty()) ball_joints = chosen_joints(balls, skeleton, "balls", work);
  std::vector<FootPoint> points;
  for (const Leg& leg : legs) {
    if (heels.empty()) add_found(skeleton, leg, "heel", points);
    if (!heels.empty()) add_chosen(skeleton, leg, "heel", heel_joints, points);
    if (balls.empty()) add_found(skeleton, leg, "ball", points);
    if (!balls.empty()) add_chosen(skeleton, leg, "ball", ball_joints, points);
  }
  if (points.empty()) {
    throw Failure(
        error("no-feet", "no joint of the skeleton looks like a foot")
            .at_port("motion")
            .hinting(
                "the skeleton needs legs of hip, knee and ankle; heels and balls choose joints at or below "
                "an ankle"));
  }
  return points;
}

std::vector<Vec3> path_of(const FootPoint& point, const WorldMotion& world) {
  std::vector<Vec3> path(world.frames());
  for (std::size_t t = 0; t < path.size(); ++t) path[t] = point_at(world, point.joint, point.local, t);
  return path;
}

}  // namespace kinegraph
