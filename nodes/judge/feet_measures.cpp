#include "nodes/judge/feet_measures.h"

#include <cmath>

namespace kinegraph {

namespace {

struct Sums {
  double travelled = 0;  // of the speeds, m/s
  std::size_t steps = 0, fast = 0;
  double depth = 0;
  std::size_t frames = 0;

  void add(const Sums& other) {
    travelled += other.travelled;
    steps += other.steps;
    fast += other.fast;
    depth += other.depth;
    frames += other.frames;
  }
};

constexpr double fast_speed = 0.05;  // m/s

Sums sums_of(const WorldMotion& world, double fps, const FootPoint& point, double floor, Window window) {
  Sums sums;
  Vec3 before;
  for (std::size_t t = window.start; t < window.end; ++t) {
    const Vec3 here = point_at(world, point.joint, point.local, t);
    sums.depth += std::max(0.0, floor - here.y);
    ++sums.frames;
    if (t > window.start && point.planted[t] && point.planted[t - 1]) {
      const double dx = here.x - before.x;
      const double dz = here.z - before.z;
      const double speed = std::sqrt(dx * dx + dz * dz) * fps;
      sums.travelled += speed;
      ++sums.steps;
      if (speed > fast_speed) ++sums.fast;
    }
    before = here;
  }
  return sums;
}

std::optional<double> ratio(double sum, std::size_t count) {
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace

FeetMeasures measure_feet(const WorldMotion& world, double fps, const Contacts& contacts,
                          const std::vector<bool>& joints, Window window) {
  const auto count = static_cast<std::size_t>(world.joints());
  std::vector<Sums> of_joint(count);
  Sums total;
  for (const FootPoint& point : contacts.points) {
    if (point.joint < 0 || !joints[static_cast<std::size_t>(point.joint)]) continue;
    const Sums sums = sums_of(world, fps, point, contacts.floor, window);
    of_joint[static_cast<std::size_t>(point.joint)].add(sums);
    total.add(sums);
  }
  FeetMeasures out;
  for (const Sums& sums : of_joint) {
    out.skate.joints.push_back(ratio(sums.travelled, sums.steps));
    out.skate_share.joints.push_back(ratio(static_cast<double>(sums.fast), sums.steps));
    out.penetration.joints.push_back(ratio(sums.depth, sums.frames));
  }
  out.skate.all = ratio(total.travelled, total.steps);
  out.skate_share.all = ratio(static_cast<double>(total.fast), total.steps);
  out.penetration.all = ratio(total.depth, total.frames);
  return out;
}

}  // namespace kinegraph
