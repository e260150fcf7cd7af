#include "nodes/cartoon/cartoon_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/cartoon/link_turns.h"
#include "nodes/cartoon/world_to_local.h"
#include "nodes/motion/elementary.h"
#include "nodes/time/gaussian.h"
#include "nodes/time/lowpass.h"

namespace kinegraph {
namespace {

// σ² g″ at 0, 1, 2 … frames: the weights of what lies k frames before and after, less what lies here. So
// uniform motion gives 0, and t² gives 2 σ².
std::vector<double> second_derivative(double sigma, std::size_t frames) {
  const std::vector<double> gaussian = Gaussian(sigma, frames).weights();
  std::vector<double> weights(gaussian.size());
  double second = 0;
  for (std::size_t k = 1; k < weights.size(); ++k) {
    const double x = static_cast<double>(k) / sigma;
    weights[k] = (x * x - 1) * gaussian[k];
    second += 2 * weights[k] * static_cast<double>(k * k);
  }
  if (second > 0)
    for (double& w : weights) w *= 2 * sigma * sigma / second;
  return weights;
}

// x − A σ² (x ∗ g″) of one series.
void sharpen(std::span<double> series, const std::vector<double>& weights, double strength) {
  const auto radius = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  const auto count = static_cast<std::ptrdiff_t>(series.size());
  std::vector<double> longer(series.size() + 2 * static_cast<std::size_t>(radius));
  for (std::ptrdiff_t i = -radius; i < count + radius; ++i) longer[i + radius] = reflected(series, i);
  for (std::ptrdiff_t k = radius; k > 0; --k) {
    const double* at = longer.data() + radius;
    for (std::ptrdiff_t i = 0; i < count; ++i)
      series[i] -= strength * weights[k] * ((at[i - k] - at[i]) + (at[i + k] - at[i]));
  }
}

void sharpen(Vec3Track track, const std::vector<double>& weights, double strength) {
  sharpen(track.x, weights, strength);
  sharpen(track.y, weights, strength);
  sharpen(track.z, weights, strength);
}

// Rotations continued at both ends by going on as they came: q₀ q_k⁻¹ q₀.
Quat continued(const ConstQuatTrack& track, std::ptrdiff_t i) {
  const auto last = static_cast<std::ptrdiff_t>(track.w.size()) - 1;
  if (i < 0) return track[0] * inverse(track[static_cast<std::size_t>(-i)]) * track[0];
  if (i > last) {
    const Quat end = track[static_cast<std::size_t>(last)];
    return end * inverse(track[static_cast<std::size_t>(2 * last - i)]) * end;
  }
  return track[static_cast<std::size_t>(i)];
}

void sharpen_rotations(ConstQuatTrack from, const std::vector<double>& weights, double strength, QuatTrack to,
                       Work& work) {
  const auto radius = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  const auto count = static_cast<std::ptrdiff_t>(from.w.size());
  std::vector<Quat> longer(static_cast<std::size_t>(count + 2 * radius));
  for (std::ptrdiff_t i = -radius; i < count + radius; ++i) longer[i + radius] = continued(from, i);
  for (std::ptrdiff_t t = 0; t < count; ++t) {
    if (t % 64 == 0) work.check();
    const Quat back = inverse(from[t]);
    Vec3 sum;  // half angles; neighbours in time are followed, so a turn of over 180° keeps its way round
    Quat before{}, after{};
    for (std::ptrdiff_t k = 1; k <= radius; ++k) {
      before = nearer(back * longer[radius + t - k], before);
      after = nearer(back * longer[radius + t + k], after);
      sum += weights[k] * (log(before) + log(after));
    }
    to.set(t, normalized(from[t] * exp(-strength * sum)));
  }
  make_continuous(to.x, to.y, to.z, to.w);
}

Motion log_on_positions(const Motion& motion, const std::vector<double>& weights, double strength,
                        Work& work) {
  const WorldMotion world = world_motion(motion, work);
  WorldMotion moved = world;
  for (int j = 0; j < motion.joints(); ++j) {
    work.check();
    sharpen(moved.position(j), weights, strength);
  }
  aim_links(motion.skeleton(), links_below(motion), world, turn_limits(motion.fps()), moved, work);
  return motion_from_world(motion.shared_skeleton(), motion.shared_source(), motion.fps(),
                           motion.translating(), moved, work);
}

void smooth(Vec3Track track, const Gaussian& gaussian) {
  gaussian.apply(track.x);
  gaussian.apply(track.y);
  gaussian.apply(track.z);
}

// The quaternion Gaussian; where the window turns so far that the sum vanishes the rotation stays as it is.
void smooth(QuatTrack track, const Gaussian& gaussian) {
  std::vector<double> x(track.x.begin(), track.x.end()), y(track.y.begin(), track.y.end()),
      z(track.z.begin(), track.z.end()), w(track.w.begin(), track.w.end());
  for (auto* series : {&x, &y, &z, &w}) gaussian.apply(*series);
  for (std::size_t t = 0; t < w.size(); ++t) {
    const Quat sum{x[t], y[t], z[t], w[t]};
    if (dot(sum, sum) > 1e-4) track.set(t, normalized(sum));
  }
  make_continuous(track.x, track.y, track.z, track.w);
}

}  // namespace

Motion log_filter(const Motion& motion, const LogFilterParams& params, Work& work) {
  const double sigma = params.sigma * motion.fps();
  if (motion.frames() < 2 || params.strength == 0 || !(sigma > 1e-3)) return motion;
  const std::vector<double> weights = second_derivative(sigma, motion.frames());
  if (params.on_positions) return log_on_positions(motion, weights, params.strength, work);
  Motion out = motion;
  work.parallel(static_cast<std::size_t>(motion.joints()), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int j = static_cast<int>(i);
      sharpen_rotations(motion.rotation(j), weights, params.strength, out.rotation(j), work);
      if (motion.translates(j)) sharpen(out.translation(j), weights, params.strength);
    }
  });
  return out;
}

Motion multiresolution_filter(const Motion& motion, const MultiresolutionParams& params, Work& work) {
  if (motion.frames() < 2 || params.gains.empty()) return motion;
  std::vector<Motion> levels{motion};  // finest first
  double sigma = params.sigma * motion.fps();
  for (std::size_t band = 0; band < params.gains.size(); ++band, sigma *= 2) {
    Motion coarser = levels.back();
    const Gaussian gaussian(std::max(sigma, 1e-3), motion.frames());
    for (int j = 0; j < motion.joints(); ++j) {
      work.check();
      smooth(coarser.rotation(j), gaussian);
      if (coarser.translates(j)) smooth(coarser.translation(j), gaussian);
    }
    levels.push_back(std::move(coarser));
  }
  Motion out = levels.back();
  for (std::size_t band = params.gains.size(); band-- > 0;) {
    const Motion &fine = levels[band], &coarse = levels[band + 1];
    const double gain = params.gains[band];
    for (int j = 0; j < motion.joints(); ++j) {
      work.check();
      const auto made = out.rotation(j);
      for (std::size_t t = 0; t < motion.frames(); ++t) {
        const Quat detail = nearer(inverse(coarse.rotation(j)[t]) * fine.rotation(j)[t], Quat{});
        made.set(t, normalized(made[t] * exp(gain * log(detail))));
      }
      if (!motion.translates(j)) continue;
      const auto place = out.translation(j);
      for (std::size_t t = 0; t < motion.frames(); ++t)
        place.set(t, place[t] + gain * (fine.translation(j)[t] - coarse.translation(j)[t]));
    }
  }
  for (int j = 0; j < motion.joints(); ++j) {
    const auto made = out.rotation(j);
    make_continuous(made.x, made.y, made.z, made.w);
  }
  return out;
}

}  // namespace kinegraph
