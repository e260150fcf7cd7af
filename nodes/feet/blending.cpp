#include "nodes/feet/blending.h"

#include <algorithm>

#include "nodes/feet/banded_system.h"
#include "nodes/motion/contacts.h"

namespace kinegraph {
namespace {

// The change at `beyond`, next to `at`, with no more than `speed` between them; where it isn't known, the
// same.
Vec3 speed_limited(const std::vector<Vec3>& change, const std::vector<bool>& known, std::size_t at,
                   std::size_t beyond, double speed) {
  if (!known[beyond]) return change[at];
  const Vec3 step = change[beyond] - change[at];
  const double length = norm(step);
  return length > speed ? change[at] + speed / length * step : change[beyond];
}

// Frames [start, end) are unknown; two known ones on each side, where there are any, hold the ends.
void fill_gap(std::vector<Vec3>& change, const std::vector<bool>& known, Run gap, double rate,
              double carried) {
  const double stiffness = rate * rate * rate * rate;
  Vec3 before, after;  // the second ones
  const auto speed_at = [&](std::size_t t) { return rate * std::max(norm(change[t]), carried); };
  if (gap.start >= 2)
    before = speed_limited(change, known, gap.start - 1, gap.start - 2, speed_at(gap.start - 1));
  if (gap.end + 1 < change.size())
    after = speed_limited(change, known, gap.end, gap.end + 1, speed_at(gap.end));
  const auto beside = [&](std::size_t t) {
    return t + 2 == gap.start ? before : t == gap.end + 1 ? after : change[t];
  };
  const std::size_t size = gap.end - gap.start;
  BandedSystem system(size, 2);
  std::vector<double> right[3];
  for (auto& axis : right) axis.assign(size, 0.0);
  for (std::size_t i = 0; i < size; ++i) system.add(i, i, stiffness);
  static constexpr double difference[3] = {1, -2, 1};
  const std::size_t first = gap.start < 2 ? 0 : gap.start - 2;
  for (std::size_t t = first; t + 2 < change.size() && t < gap.end; ++t) {
    for (int a = 0; a < 3; ++a) {
      const std::size_t row = t + a;
      if (row < gap.start || row >= gap.end) continue;
      for (int b = 0; b < 3; ++b) {
        const std::size_t column = t + b;
        const double weight = difference[a] * difference[b];
        if (column >= gap.start && column < gap.end) {
          system.add(row - gap.start, column - gap.start, weight);
        } else {
          for (int axis = 0; axis < 3; ++axis) right[axis][row - gap.start] -= weight * beside(column)[axis];
        }
      }
    }
  }
  system.factor();
  for (int axis = 0; axis < 3; ++axis) {
    system.solve(right[axis]);
    for (std::size_t i = 0; i < size; ++i) change[gap.start + i][axis] = right[axis][i];
  }
}

}  // namespace

void fill_smoothly(std::vector<Vec3>& change, const std::vector<bool>& known, double fps, double blend,
                   double carried) {
  const double rate = 2 / std::max(blend * fps, 1.0);
  std::vector<bool> unknown = known;
  unknown.flip();
  for (const Run& gap : runs_of(unknown)) {
    for (std::size_t t = gap.start; t < gap.end; ++t) change[t] = {};
    fill_gap(change, known, gap, rate, carried);
  }
}

std::vector<double> rise_smoothly(const std::vector<double>& need, const std::vector<bool>& fixed, double fps,
                                  double blend) {
  constexpr double give = 0.02;  // s
  constexpr int rounds = 12;
  const double rate = 2 / std::max(blend * fps, 1.0), force = 1 / std::max(give * fps, 1.0);
  std::vector<double> rise(need.size(), 0.0);
  std::vector<bool> free = fixed;
  free.flip();
  for (const Run& gap : runs_of(free)) {
    const auto begin = need.begin();
    if (std::none_of(begin + static_cast<std::ptrdiff_t>(gap.start),
                     begin + static_cast<std::ptrdiff_t>(gap.end), [](double n) { return n > 0; }))
      continue;
    // Which frames push changes with the rise: found in a few rounds.
    for (int round = 0; round < rounds; ++round) {
      BandedSystem system(gap.end - gap.start, 2);
      std::vector<double> right(gap.end - gap.start, 0.0);
      for (std::size_t t = gap.start; t < gap.end; ++t) {
        const bool pushes = need[t] > 0 && rise[t] < need[t];
        const double push = pushes ? force * force * force * force : 0;
        system.add(t - gap.start, t - gap.start, rate * rate * rate * rate + push);
        right[t - gap.start] = push * need[t];
      }
      static constexpr double difference[3] = {1, -2, 1};
      for (std::size_t t = gap.start < 2 ? 0 : gap.start - 2; t + 2 < need.size() && t < gap.end; ++t)
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b <= a; ++b)
            if (t + b >= gap.start && t + a < gap.end)
              system.add(t + a - gap.start, t + b - gap.start, difference[a] * difference[b]);
      system.factor();
      system.solve(right);
      std::copy(right.begin(), right.end(), rise.begin() + static_cast<std::ptrdiff_t>(gap.start));
    }
  }
  return rise;
}

}  // namespace kinegraph
