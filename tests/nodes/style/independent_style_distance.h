// Style distance by code of its own, for tests of the whole pipeline: nothing here is shared with nodes/style
// or nodes/judge. Means by plain gradient descent on the sphere from the first frame, spreads by arc cosine,
// headings by the direction in which the turned z axis looks after its tilt is undone.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nodes/motion/motion.h"
#include "nodes/style/stats.h"

namespace kinegraph::independent {

struct Rotation {
  double w = 1, x = 0, y = 0, z = 0;
};

inline Rotation times(const Rotation& a, const Rotation& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
inline Rotation back(const Rotation& a) {
  return {a.w, -a.x, -a.y, -a.z};
}
inline double cosine(const Rotation& a, const Rotation& b) {
  return std::min(1.0, std::fabs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z));
}

struct MeanAndSpread {
  Rotation mean;
  double spread = 0;  // rad, half-angle
};

inline MeanAndSpread mean_and_spread(const std::vector<Rotation>& all) {
  MeanAndSpread out;
  if (all.empty()) return out;
  out.mean = all.front();
  for (int step = 0; step < 500; ++step) {
    double x = 0, y = 0, z = 0;
    for (const Rotation& q : all) {
      Rotation d = times(back(out.mean), q);
      const double sign = d.w < 0 ? -1 : 1;
      const double sine = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
      const double angle = std::atan2(sine, sign * d.w);
      const double size = sine > 1e-12 ? angle / sine : 1.0;
      x += sign * size * d.x;
      y += sign * size * d.y;
      z += sign * size * d.z;
    }
    const double n = static_cast<double>(all.size());
    x /= n;
    y /= n;
    z /= n;
    const double length = std::sqrt(x * x + y * y + z * z);
    if (length < 1e-12) break;
    const double s = std::sin(length) / length;
    out.mean = times(out.mean, {std::cos(length), s * x, s * y, s * z});
  }
  double sum = 0;
  for (const Rotation& q : all) sum += std::pow(std::acos(cosine(out.mean, q)), 2);
  out.spread = std::sqrt(sum / static_cast<double>(all.size()));
  return out;
}

// A root's rotation without its heading. For skeletons whose root rests unturned under nothing (BVH,
// ASF/AMC).
inline Rotation without_heading(const Rotation& q) {
  const double length = std::sqrt(q.w * q.w + q.y * q.y);
  if (length < 1e-12) return q;
  return times({q.w / length, 0, -q.y / length, 0}, q);
}

struct JointDistance {
  std::string joint;
  double degrees = 0;
};
struct StyleDistance {
  double mean = 0;  // degrees
  std::vector<JointDistance> joints;
};

// Of a motion to measured statistics in quaternion space; `partner[j]`: their joint for joint j, -1 = none.
// Joints whose σ is 0.06° or less in both don't count.
inline StyleDistance style_distance(const Motion& motion, const Stats& reference,
                                    const std::vector<int>& partner) {
  constexpr double degrees = 57.29577951308232;
  StyleDistance out;
  for (int j = 0; j < motion.joints(); ++j) {
    const int other = partner[static_cast<std::size_t>(j)];
    if (other < 0) continue;
    const JointStats& theirs = reference.joints[static_cast<std::size_t>(other)];
    const ConstQuatTrack track = motion.rotation(j);
    std::vector<Rotation> all;
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      const Rotation q{track.w[t], track.x[t], track.y[t], track.z[t]};
      all.push_back(j == 0 ? without_heading(q) : q);
    }
    const MeanAndSpread mine = mean_and_spread(all);
    if (std::max(mine.spread, theirs.spread) * degrees <= 0.06) continue;
    const Rotation mean{theirs.mean.w, theirs.mean.x, theirs.mean.y, theirs.mean.z};
    const double turned = 2 * std::acos(cosine(mine.mean, mean)) * degrees;
    const double spread = 2 * (mine.spread - theirs.spread) * degrees;
    out.joints.push_back(
        {motion.skeleton().joints[static_cast<std::size_t>(j)].name, std::hypot(turned, spread)});
  }
  for (const JointDistance& joint : out.joints) out.mean += joint.degrees;
  if (!out.joints.empty()) out.mean /= static_cast<double>(out.joints.size());
  return out;
}

}  // namespace kinegraph::independent
