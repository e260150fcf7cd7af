// One point's plants, from its path alone.
#include <algorithm>
#include <cmath>

#include "nodes/feet/detect_contacts.h"

namespace kinegraph {
namespace {

// How fast a plant may slide as a whole, and by how much any of its frames may be faster than `speed`.
//   A plant that slides at 0.15 m/s is still one. The feet of captured walks slide by themselves as well, by
// what markers and fitting leave: in the clips of CMU, m21, Bandai Namco, ACCAD and Xia by under 0.05 m/s in
// half of 581 plants, by 0.07 in three quarters and by 0.10 in nine tenths: 0.15 + 0.07. Their fastest frames
// reach 0.22 m/s in one plant of twenty and 0.30 in one of a hundred, under 0.23 + 0.12.
//   Little hangs on the digits: with slides up to 0.18 or 0.33, and frames faster by 0.08 or 0.22, 98.4 % of
// the frames in which those clips' walkers rest are found, and 1.9 to 2.5 % of the others are taken for
// planted; wider limits find plants in a dancer's glides.
//   While it isn't known yet how the ground slides, its own 0.15 m/s come on top.
struct SlideLimits {
  double slide, over_speed;  // m/s
};
constexpr double drift = 0.15;
constexpr SlideLimits on_firm{0.22, 0.12}, on_sliding{on_firm.slide + drift, on_firm.over_speed + drift};
// A plant has frames whose speed is under this part of the limit.
constexpr double core = 0.6;

double horizontal(Vec3 v) {
  return std::sqrt(v.x * v.x + v.z * v.z);
}

double quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}
double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

std::vector<Vec3> velocities(const std::vector<Vec3>& path, double fps) {
  const std::size_t side = std::max<std::size_t>(1, static_cast<std::size_t>(fps / 30 + 0.5));
  std::vector<Vec3> result(path.size());
  for (std::size_t t = 0; t < path.size(); ++t) {
    const std::size_t a = t < side ? 0 : t - side, b = std::min(path.size() - 1, t + side);
    if (b > a) result[t] = (path[b] - path[a]) * (fps / static_cast<double>(b - a));
  }
  return result;
}

Vec3 median_slide(const std::vector<Vec3>& velocity, Run run) {
  std::vector<double> x, z;
  for (std::size_t t = run.start; t < run.end; ++t) {
    x.push_back(velocity[t].x);
    z.push_back(velocity[t].z);
  }
  return {median(std::move(x)), 0, median(std::move(z))};
}

// Frames where the velocity changes least, one in a tenth of a second at most: the same for every drift.
std::vector<std::size_t> steady_frames(const std::vector<Vec3>& velocity, Run run, double fps) {
  const std::size_t side = std::max<std::size_t>(1, static_cast<std::size_t>(0.03 * fps + 0.5));
  const std::size_t apart = std::max<std::size_t>(1, static_cast<std::size_t>(0.1 * fps + 0.5));
  std::vector<double> change;  // at run.start + side + k
  for (std::size_t t = run.start + side; t + side < run.end; ++t) {
    double sum = 0;
    for (std::size_t k = t - side; k < t + side; ++k) sum += norm(velocity[k + 1] - velocity[k]);
    change.push_back(sum);
  }
  std::vector<std::size_t> frames;
  for (std::size_t k = 0; k < change.size(); ++k) {
    const auto from = change.begin() + static_cast<std::ptrdiff_t>(k < apart ? 0 : k - apart);
    const auto to = change.begin() + static_cast<std::ptrdiff_t>(std::min(change.size(), k + apart + 1));
    if (std::min_element(from, to) - change.begin() != static_cast<std::ptrdiff_t>(k)) continue;
    frames.push_back(run.start + side + k);
  }
  return frames;
}

// Marks the stretches of a run that move with `slide`.
void mark_even(const std::vector<Vec3>& velocity, Run run, Vec3 slide, double speed, double largest_slide,
               std::vector<bool>& planted) {
  if (norm(slide) > largest_slide) return;
  for (std::size_t t = run.start; t < run.end; ++t) {
    std::size_t end = t;
    bool sure = false;
    for (; end < run.end && norm(velocity[end] - slide) < speed; ++end)
      sure |= norm(velocity[end] - slide) < core * speed;
    for (std::size_t k = t; sure && k < end; ++k) planted[k] = true;
    t = std::max(t, end);
  }
}

// A plant ends where its point leaves the straight slide by more than its own wobble: so a foot that rolls
// off a plant in which it stood perfectly still is let go at once, while a noisy one keeps all its frames.
void trim_ends(const std::vector<Vec3>& path, const std::vector<Vec3>& velocity, Run run,
               std::vector<bool>& planted) {
  const Vec3 slide = median_slide(velocity, run);
  // Path at rest in the plant's own frame: x, y, z, each about its median.
  std::vector<Vec3> still;
  for (std::size_t t = run.start; t < run.end; ++t)
    still.push_back(path[t] - (static_cast<double>(t - run.start)) * slide);
  Vec3 home;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vec3& p : still) values.push_back(p[axis]);
    home[axis] = median(std::move(values));
  }
  std::vector<double> away;
  for (const Vec3& p : still) away.push_back(norm(p - home));
  const double limit = std::max(0.0006, 8 * quantile(away, 0.35));
  for (std::size_t k = 0; k < away.size() && away[k] > limit; ++k) planted[run.start + k] = false;
  for (std::size_t k = away.size(); k > 0 && away[k - 1] > limit; --k) planted[run.start + k - 1] = false;
}

}  // namespace

std::vector<bool> planted_frames(const std::vector<Vec3>& path, double fps,
                                 const DetectContactsParams& params, Ground ground) {
  std::vector<bool> planted(path.size(), false);
  if (path.size() < 2) return planted;
  const std::vector<Vec3> velocity = velocities(path, fps);
  std::vector<double> heights;
  for (const Vec3& p : path) heights.push_back(p.y);
  const double ceiling = quantile(heights, 0.1) + params.height;

  const SlideLimits limits = ground == Ground::firm ? on_firm : on_sliding;
  std::vector<bool> maybe(path.size());
  for (std::size_t t = 0; t < path.size(); ++t) {
    maybe[t] = path[t].y < ceiling && std::abs(velocity[t].y) < 0.96 * params.speed &&
               horizontal(velocity[t]) < params.speed + limits.over_speed;
  }
  for (const Run& run : runs_of(maybe)) {
    mark_even(velocity, run, {}, params.speed, limits.slide, planted);
    mark_even(velocity, run, median_slide(velocity, run), params.speed, limits.slide, planted);
    for (std::size_t t : steady_frames(velocity, run, fps))
      if (!planted[t])
        mark_even(velocity, run, {velocity[t].x, 0, velocity[t].z}, params.speed, limits.slide, planted);
  }
  const auto gap = static_cast<std::size_t>(0.04 * fps + 0.5);
  std::vector<bool> open = planted;
  open.flip();
  for (const Run& run : runs_of(open))
    for (std::size_t t = run.start;
         run.start > 0 && run.end < path.size() && run.end - run.start <= gap && t < run.end; ++t)
      planted[t] = true;
  std::vector<Vec3> per_frame(path.size());
  for (std::size_t t = 1; t + 1 < path.size(); ++t) per_frame[t] = (path[t + 1] - path[t - 1]) / 2;
  per_frame.front() = path[1] - path[0];
  per_frame.back() = path.back() - path[path.size() - 2];
  for (const Run& run : runs_of(planted)) trim_ends(path, per_frame, run, planted);
  const auto least = static_cast<std::size_t>(params.min_time * fps + 0.5);
  for (const Run& run : runs_of(planted))
    for (std::size_t t = run.start; run.end - run.start < least && t < run.end; ++t) planted[t] = false;
  return planted;
}

}  // namespace kinegraph
