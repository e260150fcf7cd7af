#include "nodes/gait/gait_leg.h"

#include <algorithm>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

// Two unit axes and their cross product as the columns of a rotation.
Quat from_axes(Vec3 x, Vec3 y) {
  const Quat tilt = smallest_turn({0, 1, 0}, y);
  const Vec3 turned = rotate(tilt, {1, 0, 0});
  return axis_angle(y, arc_tangent2(dot(cross(turned, x), y), dot(turned, x))) * tilt;
}

}  // namespace

LegPose reach_ankle(Vec3 hip, Vec3 ankle, double thigh, double shank, Vec3 across) {
  const Vec3 line = ankle - hip;
  const double distance = std::clamp(norm(line), std::abs(thigh - shank) + 1e-6, thigh + shank);
  const Vec3 down = normalized(line);
  const Vec3 hinge = normalized(across - dot(across, down) * down);
  const double at_hip =
      arc_cosine((thigh * thigh + distance * distance - shank * shank) / (2 * thigh * distance));
  const double at_knee =
      arc_cosine((thigh * thigh + shank * shank - distance * distance) / (2 * thigh * shank));
  const Vec3 thigh_down = rotate(axis_angle(hinge, -at_hip), down);
  const Vec3 shank_down = rotate(axis_angle(hinge, pi - at_knee), thigh_down);
  return {from_axes(hinge, -thigh_down), from_axes(hinge, -shank_down)};
}

}  // namespace kinegraph
