#include "independent_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinegraph::independent {
namespace {

double length(Vec3 v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

// Half-angle vector of the shorter rotation.
Vec3 half_log(Quat q) {
  if (q.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
  const double s = length({q.x, q.y, q.z});
  if (s < 1e-15) return {};
  const double angle = std::atan2(s, q.w);
  return {q.x / s * angle, q.y / s * angle, q.z / s * angle};
}
Quat half_exp(Vec3 v) {
  const double angle = length(v);
  const double k = angle < 1e-12 ? 1 : std::sin(angle) / angle;
  return {v.x * k, v.y * k, v.z * k, std::cos(angle)};
}
double full_turn(Quat a, Quat b) {
  return 2 * length(half_log(inverse(a) * b));
}

std::vector<Quat> world_root(const Motion& motion) {
  std::vector<Quat> out;
  for (std::size_t t = 0; t < motion.frames(); ++t)
    out.push_back(motion.skeleton().above * motion.rotation(0)[t]);
  return out;
}

// Forward and backward second-order Butterworth with the cutoff corrected for the two passes, odd padding.
std::vector<double> smoothed(const std::vector<double>& x, double fps, double cutoff) {
  const std::size_t n = x.size(), pad = std::min<std::size_t>(n - 1, static_cast<std::size_t>(fps));
  if (n < 4) return x;
  std::vector<double> y;
  for (std::size_t i = pad; i > 0; --i) y.push_back(2 * x[0] - x[i]);
  y.insert(y.end(), x.begin(), x.end());
  for (std::size_t i = 1; i <= pad; ++i) y.push_back(2 * x[n - 1] - x[n - 1 - i]);
  const double c = std::pow(std::sqrt(2.0) - 1, 0.25);
  const double w = std::tan(M_PI * cutoff / fps) / c;
  const double k = 1 + std::sqrt(2.0) * w + w * w;
  const double b0 = w * w / k, a1 = 2 * (w * w - 1) / k, a2 = (1 - std::sqrt(2.0) * w + w * w) / k;
  for (int pass = 0; pass < 2; ++pass) {
    double x1 = y[0], x2 = y[0], y1 = y[0], y2 = y[0];
    for (double& v : y) {
      const double in = v;
      v = b0 * (in + 2 * x1 + x2) - a1 * y1 - a2 * y2;
      x2 = x1;
      x1 = in;
      y2 = y1;
      y1 = v;
    }
    std::reverse(y.begin(), y.end());
  }
  return {y.begin() + static_cast<std::ptrdiff_t>(pad), y.begin() + static_cast<std::ptrdiff_t>(pad + n)};
}

// World orientations by plain kinematics.
std::vector<std::vector<Quat>> orientations_of(const Motion& motion) {
  std::vector<std::vector<Quat>> world(motion.joints(), std::vector<Quat>(motion.frames()));
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      const int parent = motion.skeleton().joints[j].parent;
      world[j][t] = (parent < 0 ? motion.skeleton().above : world[parent][t]) * motion.rotation(j)[t];
    }
  return world;
}

// Lengths of second differences, m/s², one less than `path` at each end.
std::vector<double> accelerations(const std::vector<Vec3>& path, double fps) {
  std::vector<double> out;
  for (std::size_t t = 1; t + 1 < path.size(); ++t)
    out.push_back(length(path[t + 1] - 2 * path[t] + path[t - 1]) * fps * fps);
  return out;
}

std::vector<Vec3> smoothed(const std::vector<Vec3>& path, double fps, double cutoff) {
  std::vector<Vec3> out(path.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> series;
    for (const Vec3& p : path) series.push_back(p[axis]);
    series = smoothed(series, fps, cutoff);
    for (std::size_t t = 0; t < path.size(); ++t) out[t][axis] = series[t];
  }
  return out;
}

std::vector<Vec3> less(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> out;
  for (std::size_t t = 0; t < a.size(); ++t) out.push_back(a[t] - b[t]);
  return out;
}

}  // namespace

Spread spread_of(const std::vector<Quat>& rotations) {
  Spread out;
  Quat mean = rotations.front();
  for (int round = 0; round < 200; ++round) {
    Vec3 sum;
    for (const Quat& q : rotations) sum = sum + half_log(inverse(mean) * q);
    sum = sum / static_cast<double>(rotations.size());
    mean = normalized(mean * half_exp(sum));
    if (length(sum) < 1e-14) break;
  }
  double squares = 0;
  for (const Quat& q : rotations) {
    const double h = length(half_log(inverse(mean) * q));
    squares += h * h;
  }
  out.mean = mean;
  out.sigma = std::sqrt(squares / static_cast<double>(rotations.size()));
  return out;
}

Heading heading_of(const Motion& motion) {
  Heading out;
  const Quat rest = motion.skeleton().above * motion.skeleton().joints[0].rest;
  double before = 0;
  for (const Quat& q : world_root(motion)) {
    const Quat turned = q * inverse(rest);
    double psi = 2 * std::atan2(turned.y, turned.w);
    psi -= 2 * M_PI * std::round((psi - before) / (2 * M_PI));
    before = psi;
    out.psi.push_back(psi);
    out.rho.push_back(Quat{0, -std::sin(psi / 2), 0, std::cos(psi / 2)} * q);
  }
  return out;
}

std::map<std::string, double> style_distances(const Motion& motion, const std::vector<JointStats>& wanted) {
  const Heading heading = heading_of(motion);
  std::map<std::string, double> out;
  for (const JointStats& stats : wanted) {
    if (!stats.chosen) continue;
    const int joint = motion.skeleton().find(stats.joint);
    if (joint < 0) continue;
    std::vector<Quat> rotations;
    for (std::size_t t = 0; t < motion.frames(); ++t)
      rotations.push_back(joint == 0 ? heading.rho[t] : motion.rotation(joint)[t]);
    const Spread spread = spread_of(rotations);
    const double least = 0.06 * M_PI / 180;
    if (spread.sigma <= least && stats.spread <= least) continue;
    const double turned = full_turn(spread.mean, stats.mean), spreads = 2 * (spread.sigma - stats.spread);
    out[stats.joint] = std::sqrt(turned * turned + spreads * spreads) * 180 / M_PI;
  }
  return out;
}

double mean_of(const std::map<std::string, double>& values) {
  double sum = 0;
  for (const auto& [name, value] : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

std::vector<std::vector<Vec3>> positions_of(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  std::vector<std::vector<Vec3>> out(skeleton.joints.size(), std::vector<Vec3>(motion.frames()));
  std::vector<Quat> world(skeleton.joints.size());
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    for (int j = 0; j < skeleton.size(); ++j) {
      const int parent = skeleton.joints[j].parent;
      const Vec3 offset = motion.local_offset(j, t);
      const Quat q = motion.rotation(j)[t];
      if (parent < 0) {
        out[j][t] = skeleton.above_offset + rotate(skeleton.above, skeleton.above_scale * offset);
        world[j] = skeleton.above * q;
      } else {
        out[j][t] = out[parent][t] + rotate(world[parent], skeleton.above_scale * offset);
        world[j] = world[parent] * q;
      }
    }
  }
  return out;
}

std::map<std::string, double> largest_accelerations(const Motion& motion) {
  std::map<std::string, double> out;
  const auto positions = positions_of(motion);
  const double fps = motion.fps();
  for (int j = 0; j < motion.joints(); ++j) {
    double largest = 0;
    for (double a : accelerations(smoothed(positions[j], fps, 15), fps)) largest = std::max(largest, a);
    out[motion.skeleton().joints[j].name] = largest;
  }
  return out;
}

double farthest_from_plants(const Motion& motion, const Contacts& contacts) {
  const auto positions = positions_of(motion);
  const auto world = orientations_of(motion);
  double largest = 0;
  for (const FootPoint& point : contacts.points) {
    const int joint = motion.skeleton().find(point.joint_name);
    if (joint < 0) return std::numeric_limits<double>::infinity();
    for (const auto& run : runs_of(point.planted)) {
      const auto at = [&](std::size_t t) {
        return positions[joint][t] + rotate(world[joint][t], point.local);
      };
      Vec3 mean;
      for (std::size_t t = run.start; t < run.end; ++t)
        mean += at(t) / static_cast<double>(run.end - run.start);
      for (std::size_t t = run.start; t < run.end; ++t) largest = std::max(largest, length(at(t) - mean));
    }
  }
  return largest;
}

Added most_added(const Motion& before, const Motion& after, const Contacts& contacts) {
  const Skeleton& skeleton = before.skeleton();
  const auto from = positions_of(before), to = positions_of(after);
  const auto was = orientations_of(before), is = orientations_of(after);
  const double fps = before.fps();
  Added most;
  std::vector<std::vector<double>> repeated(from.size(), std::vector<double>(before.frames()));
  for (int joint = 0; joint < before.joints(); ++joint) {
    const int parent = skeleton.joints[joint].parent;
    if (parent >= 0) {
      const auto link = accelerations(less(from[joint], from[parent]), fps);
      for (std::size_t t = 1; t + 1 < before.frames(); ++t)
        repeated[joint][t] =
            repeated[parent][t] + 2 * std::sin(full_turn(was[parent][t], is[parent][t]) / 2) * link[t - 1];
    }
    std::vector<bool> near(before.frames(), false);
    for (const FootPoint& point : contacts.points) {
      const int ankle = skeleton.find(point.foot);
      const int hip = skeleton.joints[skeleton.joints[ankle].parent].parent;
      if (joint == hip || !skeleton.is_below(joint, hip)) continue;
      for (const Run& run : runs_of(point.planted))
        for (std::size_t t = run.start < 2 ? 0 : run.start - 2; t < std::min(near.size(), run.end + 2); ++t)
          near[t] = true;
    }
    const auto moved = less(to[joint], from[joint]);
    const auto raw = accelerations(moved, fps), calm = accelerations(smoothed(moved, fps, 15), fps);
    for (std::size_t t = 1; t + 1 < before.frames(); ++t) {
      if (near[t]) continue;
      most.raw = std::max(most.raw, raw[t - 1]);
      most.calm = std::max(most.calm, calm[t - 1]);
      most.own = std::max(most.own, raw[t - 1] - repeated[joint][t]);
    }
  }
  return most;
}

std::string joints_that_jerk(const Motion& result, const Motion& one, const Motion& other) {
  const auto first = largest_accelerations(one), second = largest_accelerations(other);
  const std::vector<int> of = partners(other.skeleton(), one.skeleton(), {});
  std::string told;
  for (const auto& [joint, largest] : largest_accelerations(result)) {
    const int at = one.skeleton().find(joint);
    double own = first.at(joint);
    if (at >= 0 && of[at] >= 0) own = std::max(own, second.at(other.skeleton().joints[of[at]].name));
    if (largest >= 2 * own + 20)
      told += fmt::format("{}: {:.0f} m/s², the larger of its inputs {:.0f}; ", joint, largest, own);
  }
  return told;
}

double mean_pitch(const Motion& motion, const std::string& from, const std::string& to,
                  const std::string& left_hip, const std::string& right_hip) {
  const auto positions = positions_of(motion);
  const auto& joint = [&](const std::string& name) -> const std::vector<Vec3>& {
    return positions[static_cast<std::size_t>(motion.skeleton().find(name))];
  };
  double sum = 0;
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    const Vec3 across = joint(left_hip)[t] - joint(right_hip)[t], torso = joint(to)[t] - joint(from)[t];
    const double forwards = (torso.z * across.x - torso.x * across.z) / std::hypot(across.x, across.z);
    sum += std::atan2(forwards, torso.y);
  }
  return sum / static_cast<double>(motion.frames()) * 180 / M_PI;
}

Steps steps_of(const Motion& motion, const std::string& left_ankle, const std::string& right_ankle) {
  const auto positions = positions_of(motion);
  const Heading heading = heading_of(motion);
  const auto& left = positions[motion.skeleton().find(left_ankle)];
  const auto& right = positions[motion.skeleton().find(right_ankle)];
  std::vector<double> ahead;
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    const Vec3 d = left[t] - right[t];
    ahead.push_back(d.x * std::sin(heading.psi[t]) + d.z * std::cos(heading.psi[t]));
  }
  ahead = smoothed(ahead, motion.fps(), 4);
  double mean = 0, square = 0;
  for (double x : ahead) mean += x / static_cast<double>(ahead.size());
  for (double x : ahead) square += (x - mean) * (x - mean) / static_cast<double>(ahead.size());
  // The extreme on each side of the middle, beyond a fifth of a sine's height of the same power.
  const double beyond = 0.2 * std::sqrt(2 * square);
  std::vector<std::size_t> extremes;
  int side = 0;
  for (std::size_t t = 0; t < ahead.size(); ++t) {
    const double x = ahead[t] - mean;
    const int now = x > beyond ? 1 : x < -beyond ? -1 : 0;
    if (now == 0) continue;
    if (now != side)
      extremes.push_back(t);
    else if (now * (ahead[t] - ahead[extremes.back()]) > 0)
      extremes.back() = t;
    side = now;
  }
  // The legs pass each other half-way between two extremes.
  std::vector<double> passings;
  for (std::size_t i = 0; i + 1 < extremes.size(); ++i) {
    const double level = (ahead[extremes[i]] + ahead[extremes[i + 1]]) / 2;
    for (std::size_t t = extremes[i]; t < extremes[i + 1]; ++t) {
      const double x = ahead[t] - level, y = ahead[t + 1] - level;
      if (x * y > 0 || x == y) continue;
      passings.push_back(static_cast<double>(t) + x / (x - y));
      break;
    }
  }
  Steps out;
  out.count = static_cast<int>(passings.size());
  if (passings.size() > 1)
    out.cadence =
        static_cast<double>(passings.size() - 1) * motion.fps() / (passings.back() - passings.front());
  return out;
}

}  // namespace kinegraph::independent
