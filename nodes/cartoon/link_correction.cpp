#include "nodes/cartoon/link_correction.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinegraph {
namespace {

constexpr std::size_t block = 256;       // frames at once: small enough for the cache
constexpr double least_part = 1.0 / 16;  // of delta: with less nothing arrives within the iterations

// One iteration: where the joints of `from` go, and the error of `from` itself.
struct Step {
  double error = 0;
  double largest = 0;  // |w| / |v|
};

Step moved_once(const Skeleton& skeleton, const std::vector<bool>& on, const std::vector<double>& lengths,
                double delta, const WorldMotion& from, WorldMotion& to, Work& work) {
  const std::size_t frames = from.frames();
  Step step;
  std::vector<double> violation(block), total(block);
  for (std::size_t start = 0; start < frames; start += block) {
    work.check();
    const std::size_t count = std::min(block, frames - start);
    std::fill(violation.begin(), violation.end(), 0.0);
    std::fill(total.begin(), total.end(), 0.0);
    for (int j = 0; j < skeleton.size(); ++j) {
      const int p = skeleton.joints[j].parent;
      const auto child = from.position(j);
      const auto out = to.position(j);
      if (p < 0 || on[j]) {
        std::copy_n(child.x.begin() + start, count, out.x.begin() + start);
        std::copy_n(child.y.begin() + start, count, out.y.begin() + start);
        std::copy_n(child.z.begin() + start, count, out.z.begin() + start);
        continue;
      }
      const auto parent = from.position(p);
      const double *cx = child.x.data() + start, *cy = child.y.data() + start, *cz = child.z.data() + start;
      const double *px = parent.x.data() + start, *py = parent.y.data() + start,
                   *pz = parent.z.data() + start;
      double *__restrict ox = out.x.data() + start, *__restrict oy = out.y.data() + start,
                         *__restrict oz = out.z.data() + start;
      const double* v = lengths.data() + static_cast<std::size_t>(j) * frames + start;
      double largest = step.largest;
      for (std::size_t i = 0; i < count; ++i) {
        const double wx = px[i] - cx[i], wy = py[i] - cy[i], wz = pz[i] - cz[i];
        const double w = std::sqrt(wx * wx + wy * wy + wz * wz);
        const double over = w - v[i];
        const double part = w > 0 ? delta * over / w : 0;
        ox[i] = cx[i] + part * wx;
        oy[i] = cy[i] + part * wy;
        oz[i] = cz[i] + part * wz;
        violation[i] += std::fabs(over);
        total[i] += v[i];
        const double ratio = v[i] > 0 ? w / v[i] : 0;
        largest = ratio > largest ? ratio : largest;
      }
      step.largest = largest;
    }
    // A joint that stands on its parent follows it; parents come first.
    for (int j = 0; j < skeleton.size(); ++j) {
      if (!on[j]) continue;
      const auto parent = std::as_const(to).position(skeleton.joints[j].parent);
      const auto out = to.position(j);
      for (std::size_t t = start; t < start + count; ++t) out.set(t, parent[t]);
    }
    for (std::size_t i = 0; i < count; ++i) step.error += total[i] > 0 ? violation[i] / total[i] : 0;
  }
  step.error /= static_cast<double>(frames);
  return step;
}

}  // namespace

std::vector<double> link_lengths(const Skeleton& skeleton, const std::vector<bool>& on_parent,
                                 const WorldMotion& world) {
  const std::size_t frames = world.frames();
  std::vector<double> lengths(frames * skeleton.joints.size());
  for (int j = 1; j < skeleton.size(); ++j) {
    if (on_parent[j]) continue;
    const auto child = world.position(j), parent = world.position(skeleton.joints[j].parent);
    double* v = lengths.data() + static_cast<std::size_t>(j) * frames;
    for (std::size_t t = 0; t < frames; ++t) v[t] = norm(parent[t] - child[t]);
  }
  return lengths;
}

LinkStretch link_stretch(const Skeleton& skeleton, const std::vector<double>& lengths,
                         const WorldMotion& moved, int only) {
  LinkStretch stretch;
  const std::size_t frames = moved.frames();
  for (int j = 1; j < skeleton.size(); ++j) {
    if (only >= 0 && j != only) continue;
    const auto child = moved.position(j), parent = moved.position(skeleton.joints[j].parent);
    const double* v = lengths.data() + static_cast<std::size_t>(j) * frames;
    for (std::size_t t = 0; t < frames; ++t) {
      if (!(v[t] > 0)) continue;
      const double ratio = norm(parent[t] - child[t]) / v[t];
      if (stretch.largest_joint < 0 || ratio > stretch.largest) {
        stretch.largest = ratio;
        stretch.largest_joint = j;
        stretch.largest_frame = t;
      }
      if (stretch.smallest_joint < 0 || ratio < stretch.smallest) {
        stretch.smallest = ratio;
        stretch.smallest_joint = j;
        stretch.smallest_frame = t;
      }
    }
  }
  return stretch;
}

LinkCorrectionResult correct_links(const Skeleton& skeleton, const std::vector<bool>& on_parent,
                                   const std::vector<double>& lengths, const LinkCorrectionParams& params,
                                   WorldMotion& moved, Work& work) {
  LinkCorrectionResult result;
  result.delta = params.delta;
  if (moved.frames() == 0) {
    result.met = true;
    return result;
  }
  WorldMotion next = moved, best = moved;
  double delta = params.delta;
  const auto once = [&] { return moved_once(skeleton, on_parent, lengths, delta, moved, next, work); };
  const auto is_met = [&](const Step& step) {
    return step.error <= params.error && (params.max_link <= 0 || step.largest <= params.max_link);
  };
  // `moved` has been looked at, `next` is where it goes from there. Where a joint with many children moves
  // its own link gains less than theirs lose, and the error rises until the move has passed down to the tips:
  // so it goes on from what it has come to, by smaller steps, and `best` is what it falls back on.
  Step step = once();
  result.error = result.error_before = step.error;
  result.met = is_met(step);
  double before = step.error;
  bool is_best = true;
  while (!result.met && result.iterations < params.iterations) {
    ++result.iterations;
    if (is_best) std::swap(best, moved);
    std::swap(moved, next);
    step = once();
    result.met = is_met(step);
    is_best = result.met || step.error <= result.error;
    if (is_best) result.error = step.error;
    delta = step.error > before ? std::max(0.5 * delta, least_part * params.delta)
                                : std::min(2 * delta, params.delta);
    result.delta = std::min(result.delta, delta);
    before = step.error;
  }
  if (!is_best) std::swap(best, moved);
  return result;
}

}  // namespace kinegraph
