#include "nodes/judge/breaks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

constexpr double times_usual = 8, times_neighbour = 4, remains = 1.0 / 3;
constexpr std::size_t around = 8, longest_spike = 3;
constexpr double least_turn = 10 / degrees_per_radian, flip_turn = 90 / degrees_per_radian;
constexpr double least_of_height = 0.01;
constexpr double unknown = -1;  // a step from or to a missing sample

// The median of the steps around `at`, itself and its next three left out: a spike's way back isn't usual.
double usual_step(const std::vector<double>& steps, std::size_t at) {
  double sorted[2 * around];
  std::size_t count = 0;
  for (std::size_t i = at > around ? at - around : 0; i < std::min(steps.size(), at + around + 1); ++i)
    if ((i < at || i > at + longest_spike) && steps[i] != unknown) sorted[count++] = steps[i];
  if (count == 0) return 0;
  std::nth_element(sorted, sorted + count / 2, sorted + count);
  return sorted[count / 2];
}

// `apart(a, b)`: distance between two frames of the channel, or `unknown`.
template <class Apart>
void find_breaks(std::size_t first, std::size_t end, Apart apart, double least, Break like,
                 std::vector<Break>& found) {
  if (end < first + 4) return;
  std::vector<double> steps(end - first - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = apart(first + i, first + i + 1);
  auto is_large = [&](std::size_t i) {
    return steps[i] > least && steps[i] > times_usual * usual_step(steps, i);
  };
  auto step_at = [&](std::size_t i) { return i < steps.size() ? std::max(steps[i], 0.0) : 0.0; };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!is_large(i)) continue;
    Break one = like;
    one.frame = first + i + 1;
    for (std::size_t width = 1; width <= longest_spike && i + width < steps.size(); ++width) {
      one.size = std::max(one.size, apart(first + i, first + i + width));
      const double back = apart(first + i, first + i + width + 1);
      if (back == unknown || steps[i + width] < remains * one.size || back > remains * one.size) continue;
      one.kind = Break::Kind::spike;
      one.frames = width;
      break;
    }
    if (one.frames > 0) {
      found.push_back(one);
      i += one.frames;
      continue;
    }
    const double before = i > 0 ? step_at(i - 1) : 0;
    if (times_neighbour * std::max(before, step_at(i + 1)) > steps[i]) continue;
    one.size = steps[i];
    one.kind = one.turns && one.size >= flip_turn ? Break::Kind::flip : Break::Kind::jump;
    found.push_back(one);
  }
}

}  // namespace

const char* name_of(Break::Kind kind) {
  return kind == Break::Kind::flip ? "flip" : kind == Break::Kind::jump ? "jump" : "spike";
}

std::vector<Break> breaks_of(const Motion& motion, std::size_t first, Work& work) {
  std::vector<Break> found;
  for (int j = 0; j < motion.joints(); ++j) {
    work.check();
    const Motion& is = motion;
    const auto q = is.rotation(j);
    find_breaks(
        first, motion.frames(), [&](std::size_t a, std::size_t b) { return turn(q[a], q[b]); }, least_turn,
        {Break::Kind::jump, j, 0, 0, true, 0}, found);
    if (!motion.translates(j)) continue;
    const auto p = is.translation(j);
    const double least = least_of_height * rest_height(motion.skeleton());
    find_breaks(
        first, motion.frames(), [&](std::size_t a, std::size_t b) { return norm(p[b] - p[a]); },
        std::max(least, 1e-6), {Break::Kind::jump, j, 0, 0, false, 0}, found);
  }
  return found;
}

std::vector<Break> breaks_of(const Points& points, Work& work) {
  std::vector<Break> found;
  const double least = std::max(least_of_height * extent_of(points), 1e-9);
  for (int label = 0; label < static_cast<int>(points.labels.size()); ++label) {
    work.check();
    const auto p = points.track(label);
    find_breaks(
        0, points.frames,
        [&](std::size_t a, std::size_t b) {
          return points.is_missing(label, a) || points.is_missing(label, b) ? unknown : norm(p[b] - p[a]);
        },
        least, {Break::Kind::jump, label, 0, 0, false, 0}, found);
  }
  return found;
}

double extent_of(const Points& points) {
  double largest = 0;
  for (std::size_t t = 0; t < points.frames; ++t) {
    Vec3 low, high;
    bool any = false;
    for (int label = 0; label < static_cast<int>(points.labels.size()); ++label) {
      if (points.is_missing(label, t)) continue;
      const Vec3 p = points.track(label)[t];
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = any ? std::min(low[axis], p[axis]) : p[axis];
        high[axis] = any ? std::max(high[axis], p[axis]) : p[axis];
      }
      any = true;
    }
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, high[axis] - low[axis]);
  }
  return largest;
}

}  // namespace kinegraph
