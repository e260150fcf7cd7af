#include "nodes/judge/distance_measures.h"

#include <cmath>
#include <utility>

#include "nodes/motion/elementary.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/time/dynamic_time_warp.h"

namespace kinegraph {

namespace {

constexpr double rigid_spread = 0.06 / degrees_per_radian;  // σ of a joint that doesn't take part in style

Measured nothing(const Compared& pair) {
  Measured out;
  out.joints.resize(pair.partner.size());
  return out;
}

// Joint positions with the root's place and heading taken out: three dims for each joint in `joints`.
Series positions_from_root(const Motion& motion, const WorldMotion& world, const std::vector<int>& joints,
                           Window window, Work& work) {
  const EncodedRoot root = encode_root(motion, work);
  Series out(window.size(), 3 * joints.size());
  const ConstVec3Track centre = world.position(0);
  std::vector<Quat> unturn;
  for (std::size_t t = window.start; t < window.end; ++t) unturn.push_back(about_y(-root.heading[t]));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    work.check();
    const ConstVec3Track track = world.position(joints[i]);
    for (std::size_t t = window.start; t < window.end; ++t) {
      const std::size_t row = t - window.start;
      const Vec3 p = rotate(unturn[row], track[t] - centre[t]);
      out.dim(3 * i)[row] = p.x;
      out.dim(3 * i + 1)[row] = p.y;
      out.dim(3 * i + 2)[row] = p.z;
    }
  }
  return out;
}

}  // namespace

Measured position_distance(const Compared& pair, Window window) {
  Measured out = nothing(pair);
  if (pair.motion.frames() != pair.reference.frames() || window.size() == 0) return out;
  for (std::size_t j = 0; j < pair.partner.size(); ++j) {
    if (pair.partner[j] < 0) continue;
    const ConstVec3Track a = pair.world.position(static_cast<int>(j));
    const ConstVec3Track b = pair.reference_world.position(pair.partner[j]);
    double sum = 0;
    for (std::size_t t = window.start; t < window.end; ++t) sum += norm(a[t] - b[t]);
    out.joints[j] = sum / static_cast<double>(window.size());
  }
  out.all = mean_of(out.joints);
  return out;
}

Measured rotation_distance(const Compared& pair, Window window) {
  Measured out = nothing(pair);
  if (pair.motion.frames() != pair.reference.frames() || window.size() == 0) return out;
  for (std::size_t j = 0; j < pair.partner.size(); ++j) {
    if (pair.partner[j] < 0) continue;
    const ConstQuatTrack a = pair.motion.rotation(static_cast<int>(j));
    const ConstQuatTrack b = pair.reference.rotation(pair.partner[j]);
    double sum = 0;
    for (std::size_t t = window.start; t < window.end; ++t) sum += turn(a[t], b[t]);
    out.joints[j] = sum / static_cast<double>(window.size()) * degrees_per_radian;
  }
  out.all = mean_of(out.joints);
  return out;
}

Measured aligned_distance(const Compared& pair, Window window, Work& work) {
  Measured out = nothing(pair);
  std::vector<int> joints, partners;
  for (std::size_t j = 0; j < pair.partner.size(); ++j) {
    if (pair.partner[j] < 0) continue;
    joints.push_back(static_cast<int>(j));
    partners.push_back(pair.partner[j]);
  }
  if (joints.empty() || window.size() == 0 || pair.reference.frames() == 0) return out;

  const Series a = positions_from_root(pair.motion, pair.world, joints, window, work);
  const Series b =
      positions_from_root(pair.reference, pair.reference_world, partners, {0, pair.reference.frames()}, work);
  const Correspondence path = align(a, b, 0, false, work);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    double sum = 0;
    for (const auto& [row, other] : path.pairs) {
      const Vec3 apart{a.at(3 * i, row) - b.at(3 * i, other), a.at(3 * i + 1, row) - b.at(3 * i + 1, other),
                       a.at(3 * i + 2, row) - b.at(3 * i + 2, other)};
      sum += norm(apart);
    }
    out.joints[static_cast<std::size_t>(joints[i])] = sum / static_cast<double>(path.pairs.size());
  }
  out.all = mean_of(out.joints);
  return out;
}

Measured style_distance(const Stats& stats, const Stats& reference, const std::vector<int>& partner) {
  Measured out;
  out.joints.resize(partner.size());
  for (std::size_t j = 0; j < partner.size(); ++j) {
    if (partner[j] < 0) continue;
    const JointStats& a = stats.joints[j];
    const JointStats& b = reference.joints[static_cast<std::size_t>(partner[j])];
    if (!a.chosen || !b.chosen || !(a.spread > rigid_spread || b.spread > rigid_spread)) continue;
    const double means = turn(a.mean, b.mean);
    const double spreads = 2 * (a.spread - b.spread);
    out.joints[j] = std::sqrt(means * means + spreads * spreads) * degrees_per_radian;
  }
  out.all = mean_of(out.joints);
  return out;
}

}  // namespace kinegraph
