#include "gui/evaluation/still.h"

#include <algorithm>
#include <cmath>

#include "headless/draws/skeleton_figure.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

Still make_still(const Motion& motion, int figures) {
  Still still;
  const Skeleton& skeleton = motion.skeleton();
  const std::size_t frames = motion.frames();
  if (frames == 0 || skeleton.size() < 2) return still;
  const Figure figure(skeleton);
  still.figures = std::clamp<int>(figures, 1, int(frames));
  std::vector<Pose> poses;
  for (int i = 0; i < still.figures; ++i)
    poses.push_back(pose_at(
        motion, still.figures == 1 ? 0 : std::size_t(i) * (frames - 1) / std::size_t(still.figures - 1)));
  const auto root = [&](const Pose& pose) { return pose.positions[std::size_t(figure.body())]; };
  // Across the way it goes, a little from the front; from the front where it stays.
  const Vec3 way = root(poses.back()) - root(poses.front());
  const double length = std::hypot(way.x, way.z);
  double right_x = 0.8, right_z = -0.6;
  if (length > 0.3 * figure.height()) {
    const double x = way.x / length, z = way.z / length;
    right_x = 0.94 * x - 0.34 * z;
    right_z = 0.94 * z + 0.34 * x;
  }
  double floor = 1e300, top = -1e300;
  for (const Pose& pose : poses)
    for (int joint : figure.joints()) {
      const double y = pose.positions[std::size_t(joint)].y;
      floor = std::min(floor, y);
      top = std::max(top, y);
    }
  const double scale = 1 / figure.height();
  still.height = std::max(0.6, (top - floor) * scale);
  for (int i = 0; i < still.figures; ++i) {
    const Pose& pose = poses[std::size_t(i)];
    const Vec3 middle = root(pose);
    const auto seen = [&](const Vec3& p) {
      return QPointF(((p.x - middle.x) * right_x + (p.z - middle.z) * right_z) * scale,
                     (p.y - floor) * scale);
    };
    const auto add = [&](int joint, const Vec3& from, const Vec3& to) {
      const Side side = figure.side(joint);
      still.limbs.push_back({QLineF(seen(from), seen(to)),
                             side == Side::left    ? Still::Side::left
                             : side == Side::right ? Still::Side::right
                                                   : Still::Side::middle,
                             i});
    };
    for (int joint : figure.joints()) {
      const int parent = skeleton.joints[std::size_t(joint)].parent;
      if (joint != figure.body() && parent >= 0)
        add(joint, pose.positions[std::size_t(parent)], pose.positions[std::size_t(joint)]);
    }
    for (const EndSite& end : skeleton.ends)
      if (skeleton.is_below(end.joint, figure.body()))
        add(end.joint, pose.positions[std::size_t(end.joint)],
            pose.positions[std::size_t(end.joint)] +
                rotate(pose.orientations[std::size_t(end.joint)], skeleton.above_scale * end.offset));
  }
  return still;
}

}  // namespace kinegraph
