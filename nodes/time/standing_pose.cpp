#include "nodes/time/standing_pose.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/character.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

constexpr double upright_cosine = 0.64;  // 50°

Pose frame_of(const WorldMotion& world, std::size_t t) {
  Pose pose;
  for (int j = 0; j < world.joints(); ++j) {
    pose.positions.push_back(world.position(j)[t]);
    pose.orientations.push_back(world.orientation(j)[t]);
  }
  return pose;
}

// The joint that shows where the trunk leads, as far up as there is one. -1: none.
int top_of(const Body& body) {
  if (body.head >= 0) return body.head;
  if (!body.neck.empty()) return body.neck.back();
  return body.spine.empty() ? -1 : body.spine.back();
}

// Cosine of the angle with up, of the trunk or the legs, whichever is less upright.
template <class At>
double uprightness(const Body& body, const At& at) {
  double least = 1;
  const auto take = [&](int low, int high) {
    const Vec3 way = at(high) - at(low);
    least = std::min(least, norm(way) > 0 ? way.y / norm(way) : -1);
  };
  if (const int top = top_of(body); top >= 0 && top != body.pelvis) take(body.pelvis, top);
  for (const Leg& leg : body.legs) take(leg.ankle, leg.hip);
  return least;
}

std::optional<double> facing_of(const Body& body, const Pose& pose) {
  Vec3 left;
  const auto take = [&](bool is_left, int joint) {
    left += (is_left ? 1 : -1) * pose.positions[static_cast<std::size_t>(joint)];
  };
  if (body.legs.size() == 2)
    for (const Leg& leg : body.legs) take(leg.left, leg.hip);
  if (body.arms.size() == 2)
    for (const Arm& arm : body.arms) take(arm.left, arm.upper);
  return yaw_of(cross(left, {0, 1, 0}));
}

Pose flat_frame(const WorldMotion& world, const Leg& leg) {
  std::size_t best = 0;
  double lowest = 0;
  for (std::size_t t = 0; t < world.frames(); ++t) {
    double height = world.position(leg.ankle)[t].y;
    if (leg.toe >= 0) height += world.position(leg.toe)[t].y;
    if (t == 0 || height < lowest) {
      lowest = height;
      best = t;
    }
  }
  return frame_of(world, best);
}

}  // namespace

std::optional<double> yaw_of(Vec3 v) {
  const double flat = std::sqrt(v.x * v.x + v.z * v.z);
  if (flat <= 0.1 * norm(v) || flat == 0) return {};
  return arc_tangent2(v.x, v.z);
}

std::optional<Vec3> ball_of(const Leg& leg, const Pose& pose, double scale) {
  if (leg.toe >= 0) return pose.positions[static_cast<std::size_t>(leg.toe)];
  if (!leg.toe_tip) return {};
  const auto ankle = static_cast<std::size_t>(leg.ankle);
  return pose.positions[ankle] + rotate(pose.orientations[ankle], scale * *leg.toe_tip);
}

StandingPose standing_pose(const Motion& motion, const WorldMotion& world, const Body& body) {
  StandingPose standing;
  standing.pose = rest_pose_of(motion.skeleton());
  const auto at_rest = [&](int j) { return standing.pose.positions[static_cast<std::size_t>(j)]; };
  double best = body.pelvis < 0 ? 1 : uprightness(body, at_rest);
  if (best < upright_cosine) {
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      const double now = uprightness(body, [&](int j) { return world.position(j)[t]; });
      if (now <= best) continue;
      best = now;
      standing.frame = t;
    }
  }
  if (standing.frame) standing.pose = frame_of(world, *standing.frame);
  standing.upright = best >= upright_cosine;
  standing.facing = facing_of(body, standing.pose);
  for (const Leg& leg : body.legs)
    standing.flat.push_back(standing.frame ? flat_frame(world, leg) : standing.pose);
  return standing;
}

}  // namespace kinegraph
