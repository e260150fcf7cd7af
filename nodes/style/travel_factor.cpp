#include "nodes/style/travel_factor.h"

#include <algorithm>

#include "nodes/motion/encoded_root.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

namespace {

constexpr double low = 0.04;  // m above the usual low, as DetectContacts' default

// The 10th percentile of a point's height, and what counts as low above it.
double height_of_low(const WorldMotion& world, const FootPoint& point) {
  std::vector<double> heights(world.frames());
  for (std::size_t t = 0; t < heights.size(); ++t)
    heights[t] = point_at(world, point.joint, point.local, t).y;
  const auto tenth = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
  std::nth_element(heights.begin(), tenth, heights.end());
  return *tenth + low;
}

}  // namespace

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

bool holds_frames(const Motion& motion) {
  if (motion.frames() < 2 || motion.joints() < 2) return false;
  std::vector<bool> moves(motion.frames());
  bool any = false;
  for (int j = 1; j < motion.joints(); ++j) {
    const ConstQuatTrack q = motion.rotation(j);
    for (std::size_t t = 1; t < motion.frames(); ++t) {
      if (q[t] == q[t - 1]) continue;
      moves[t] = true;
      any = true;
    }
  }
  return any && std::find(moves.begin() + 1, moves.end(), false) != moves.end();
}

std::optional<double> sweep_factor(const Motion& before, const Motion& after, const Contacts& contacts,
                                   const std::vector<bool>& counted, Work& work) {
  const EncodedRoot root = encode_root(before, work);
  const WorldMotion world = world_motion(before, work);
  const WorldMotion changed = world_motion(after, work);
  double both = 0;     // Σ b·b′
  double squared = 0;  // Σ b·b
  for (const FootPoint& point : contacts.points) {
    work.check();
    const double limit = height_of_low(world, point);
    const auto from_root = [&](const WorldMotion& of, std::size_t t) {
      return rotate(about_y(-root.heading[t]), point_at(of, point.joint, point.local, t) - of.position(0)[t]);
    };
    const auto is_low = [&](std::size_t t) { return point_at(world, point.joint, point.local, t).y < limit; };
    for (std::size_t t = 1; t < before.frames(); ++t) {
      if ((!counted.empty() && !counted[t]) || !is_low(t) || !is_low(t - 1)) continue;
      const Vec3 b = from_root(world, t) - from_root(world, t - 1);
      const Vec3 c = from_root(changed, t) - from_root(changed, t - 1);
      both += b.x * c.x + b.z * c.z;
      squared += b.x * b.x + b.z * b.z;
    }
  }
  if (!(squared > 1e-12)) return std::nullopt;
  return both / squared;
}

}  // namespace kinegraph
