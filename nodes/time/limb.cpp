#include "nodes/time/limb.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

double rest_distance(const RestPose& rest, int a, int b) {
  return norm(rest.positions[a] - rest.positions[b]);
}

Vec3 across(Vec3 direction) {
  const Vec3 d = normalized(direction);
  const Vec3 axis = std::fabs(d.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  return normalized(cross(d, axis));
}

}  // namespace

std::optional<Limb> limb_of(const Skeleton& skeleton, int joint) {
  const RestPose rest = rest_pose(skeleton);
  std::optional<Limb> best;
  double best_side = 0;
  for (int middle = skeleton.joints[joint].parent; middle > 0; middle = skeleton.joints[middle].parent) {
    const int upper = skeleton.joints[middle].parent;
    if (upper == 0 && best) break;
    const double side = std::min(rest_distance(rest, upper, middle), rest_distance(rest, middle, joint));
    if (side <= best_side * (1 + 1e-9)) continue;
    best = Limb{upper, middle};
    best_side = side;
  }
  return best;
}

Vec3 usual_bend(const Motion& motion, const Limb& limb, int joint) {
  Vec3 sum, along;
  const std::size_t step = std::max<std::size_t>(1, motion.frames() / 200);
  for (std::size_t f = 0; f < motion.frames(); f += step) {
    const Pose pose = pose_at(motion, f);
    const Vec3 first = pose.positions[limb.middle] - pose.positions[limb.upper];
    const Quat back = inverse(pose.orientations[limb.upper]);
    sum += rotate(back, cross(first, pose.positions[joint] - pose.positions[limb.middle]));
    along = rotate(back, first);
  }
  const double size = norm(sum);
  return size > 1e-6 * dot(along, along) ? sum / size : across(along);
}

Reached reach(const Motion& motion, const Pose& pose, std::size_t frame, const Limb& limb, int joint,
              Vec3 goal, Vec3 bend) {
  Reached result{motion.rotation(limb.upper)[frame], motion.rotation(limb.middle)[frame]};
  const Vec3 a = pose.positions[limb.upper], b = pose.positions[limb.middle], t = pose.positions[joint];
  const double upper = norm(b - a), lower = norm(t - b), wanted = norm(goal - a);
  constexpr double slack = 1e-9;
  result.missing =
      std::max({0.0, wanted - (upper + lower) - slack, std::fabs(upper - lower) - wanted - slack});
  if (result.missing > 0) return result;

  // Bend the middle joint: the angle there between the two sides, by the law of cosines.
  const auto inside = [&](double side) {
    return arc_cosine((upper * upper + lower * lower - side * side) / (2 * upper * lower));
  };
  Vec3 normal = cross(b - a, t - b);
  normal = norm(normal) > 1e-6 * upper * lower ? normalized(normal) : bend;
  const Vec3 first = a - b, second = t - b;
  const double angle = arc_tangent2(norm(cross(first, second)), dot(first, second));
  const Quat bending = axis_angle(normal, angle - inside(wanted));
  const Vec3 bent = b + rotate(bending, second);
  const Quat aiming = smallest_turn(bent - a, goal - a);

  const Quat upper_world = pose.orientations[limb.upper], middle_world = pose.orientations[limb.middle];
  const Quat upper_local = motion.rotation(limb.upper)[frame];
  const Quat above = upper_world * inverse(upper_local);  // orientation of what the upper joint hangs on
  result.upper = normalized(inverse(above) * (aiming * upper_world));
  result.middle = normalized(inverse(upper_world) * (bending * middle_world));
  return result;
}

}  // namespace kinegraph
