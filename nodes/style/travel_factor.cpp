#include "nodes/style/travel_factor.h"

#include "nodes/motion/kinematics.h"

namespace kinegraph {

std::optional<double> travel_factor(const Motion& motion, const Contacts& contacts,
                                    const std::vector<bool>& counted, Work& work) {
  const WorldMotion world = world_motion(motion, work);
  const ConstVec3Track root = world.position(0);
  double along = 0;    // Σ a·b
  double squared = 0;  // Σ a·a
  for (const FootPoint& point : contacts.points) {
    work.check();
    for (std::size_t t = 1; t < motion.frames(); ++t) {
      if (!point.planted[t] || !point.planted[t - 1] || (!counted.empty() && !counted[t])) continue;
      const Vec3 a = root[t] - root[t - 1];
      const Vec3 b =
          point_at(world, point.joint, point.local, t) - point_at(world, point.joint, point.local, t - 1) - a;
      along += a.x * b.x + a.z * b.z;
      squared += a.x * a.x + a.z * a.z;
    }
  }
  if (!(squared > 1e-12)) return std::nullopt;
  return -along / squared;
}

}  // namespace kinegraph
