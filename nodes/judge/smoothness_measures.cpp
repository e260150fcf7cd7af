#include "nodes/judge/smoothness_measures.h"

#include <cmath>

#include "nodes/judge/spectral_arc_length.h"
#include "nodes/motion/moving_root.h"
#include "nodes/time/lowpass.h"

namespace kinegraph {

namespace {

constexpr double smoothing_cutoff = 15;  // Hz
constexpr int smoothing_order = 2;

using Channel = std::vector<double>;

Channel smoothed(std::span<const double> values, const Lowpass& filter) {
  Channel out(values.begin(), values.end());
  filter.apply(out);
  return out;
}

std::optional<double> mean_jerk(const ConstVec3Track& p, double fps, Window window) {
  if (window.size() < 4) return std::nullopt;
  double sum = 0;
  for (std::size_t t = window.start + 3; t < window.end; ++t) {
    sum += norm(p[t] - 3 * p[t - 1] + 3 * p[t - 2] - p[t - 3]);
  }
  return sum / static_cast<double>(window.size() - 3) * fps * fps * fps;
}

std::optional<double> largest_acceleration(const ConstVec3Track& p, double fps, const Lowpass& filter,
                                           Window window) {
  if (window.size() < 3) return std::nullopt;
  const Channel x = smoothed(p.x, filter);
  const Channel y = smoothed(p.y, filter);
  const Channel z = smoothed(p.z, filter);
  double largest = 0;
  for (std::size_t t = window.start + 2; t < window.end; ++t) {
    const Vec3 second{x[t] - 2 * x[t - 1] + x[t - 2], y[t] - 2 * y[t - 1] + y[t - 2],
                      z[t] - 2 * z[t - 1] + z[t - 2]};
    largest = std::max(largest, dot(second, second));
  }
  return std::sqrt(largest) * fps * fps;
}

std::optional<double> largest_angular_acceleration(const ConstQuatTrack& q, double fps, const Lowpass& filter,
                                                   Window window) {
  if (window.size() < 3) return std::nullopt;
  const Channel x = smoothed(q.x, filter);
  const Channel y = smoothed(q.y, filter);
  const Channel z = smoothed(q.z, filter);
  const Channel w = smoothed(q.w, filter);
  const auto at = [&](std::size_t t) { return normalized(Quat{x[t], y[t], z[t], w[t]}); };
  double largest = 0;
  Quat last = at(window.start + 1);
  const auto step = [](Quat from, Quat to) { return 2 * log(nearer(to * inverse(from), Quat{})); };
  Vec3 before = step(at(window.start), last);
  for (std::size_t t = window.start + 2; t < window.end; ++t) {
    const Quat here = at(t);
    const Vec3 now = step(last, here);
    const Vec3 change = now - before;
    largest = std::max(largest, dot(change, change));
    before = now;
    last = here;
  }
  return std::sqrt(largest) * fps * fps;
}

Channel speeds(const ConstVec3Track& p, double fps, Window window) {
  Channel out;
  for (std::size_t t = window.start + 1; t < window.end; ++t) out.push_back(norm(p[t] - p[t - 1]) * fps);
  return out;
}

std::optional<double> largest_bone_drift(const Motion& motion, int joint, Window window) {
  const double rest = motion.skeleton().link_length(joint);
  if (joint == 0 || rest < 1e-6 || window.size() == 0) return std::nullopt;
  if (!motion.translates(joint)) return 0.0;
  if (carries_the_legs(motion.skeleton(), joint)) return std::nullopt;
  double largest = 0;
  for (std::size_t t = window.start; t < window.end; ++t) {
    largest = std::max(largest, std::fabs(norm(motion.local_offset(joint, t)) / rest - 1));
  }
  return largest;
}

}  // namespace

SmoothnessMeasures measure_smoothness(const Motion& motion, const WorldMotion& world,
                                      const std::vector<bool>& joints, Window window, Work& work) {
  SmoothnessMeasures out;
  const std::size_t count = joints.size();
  for (Measured* measured :
       {&out.jerk, &out.sparc, &out.acceleration_max, &out.angular_acceleration_max, &out.bone_drift}) {
    measured->joints.resize(count);
  }
  const double fps = motion.fps();
  const Lowpass smoothing(fps, smoothing_cutoff, smoothing_order);
  const SpectralArcLength arc_length(window.size() > 0 ? window.size() - 1 : 0, fps);
  work.parallel(count, 2, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      work.check();
      if (!joints[j]) continue;
      const int joint = static_cast<int>(j);
      const ConstVec3Track position = world.position(joint);
      out.jerk.joints[j] = mean_jerk(position, fps, window);
      out.acceleration_max.joints[j] = largest_acceleration(position, fps, smoothing, window);
      out.angular_acceleration_max.joints[j] =
          largest_angular_acceleration(motion.rotation(joint), fps, smoothing, window);
      out.bone_drift.joints[j] = largest_bone_drift(motion, joint, window);
      work.check();
      out.sparc.joints[j] = arc_length(speeds(position, fps, window));
    }
  });
  out.jerk.all = mean_of(out.jerk.joints);
  out.sparc.all = mean_of(out.sparc.joints);
  out.acceleration_max.all = largest_of(out.acceleration_max.joints);
  out.angular_acceleration_max.all = largest_of(out.angular_acceleration_max.joints);
  out.bone_drift.all = largest_of(out.bone_drift.joints);
  return out;
}

}  // namespace kinegraph
