#include "nodes/cartoon/link_turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace kinegraph {
namespace {

constexpr double hold_to_identity = 0.005;  // of the links' squared length, about each axis
constexpr double zero_link = 1e-6;          // of the height
constexpr std::size_t frames_between_checks = 512;

using Matrix4 = std::array<std::array<double, 4>, 4>;

// The square of a symmetric matrix, brought to trace 1.
Matrix4 squared(const Matrix4& m) {
  Matrix4 out;
  for (int r = 0; r < 4; ++r) {
    for (int c = r; c < 4; ++c) {
      out[r][c] = m[r][0] * m[c][0] + m[r][1] * m[c][1] + m[r][2] * m[c][2] + m[r][3] * m[c][3];
      out[c][r] = out[r][c];
    }
  }
  const double trace = out[0][0] + out[1][1] + out[2][2] + out[3][3];
  for (auto& row : out)
    for (double& value : row) value /= trace;
  return out;
}

}  // namespace

Quat best_turn(std::span<const Vec3> from, std::span<const Vec3> to) {
  double s[3][3] = {};
  double size = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) s[r][c] += from[i][r] * to[i][c];
    size += norm(from[i]) * norm(to[i]);
  }
  if (!(size > 0)) return {};
  for (int i = 0; i < 3; ++i) s[i][i] += hold_to_identity * size;
  const double bound = (1 + 3 * hold_to_identity) * size;  // of the largest eigenvalue's size
  // Horn's matrix, rows w x y z; its dominant eigenvector is the rotation. Shifted to be positive, squared
  // ten times: all but that direction fades by the 4096th power.
  Matrix4 n;
  n[0] = {s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]};
  n[1] = {n[0][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]};
  n[2] = {n[0][2], n[1][2], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]};
  n[3] = {n[0][3], n[1][3], n[2][3], s[2][2] - s[0][0] - s[1][1]};
  for (int i = 0; i < 4; ++i) n[i][i] += bound;
  for (int round = 0; round < 12; ++round) n = squared(n);
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (n[i][i] > n[largest][largest]) largest = i;
  const auto& q = n[largest];
  return normalized(nearer(Quat{q[1], q[2], q[3], q[0]}, Quat{}));
}

std::vector<bool> on_parent(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  const double least = zero_link * rest_height(skeleton);
  std::vector<bool> on(static_cast<std::size_t>(skeleton.size()));
  for (int j = 1; j < skeleton.size(); ++j)
    on[j] = !motion.translates(j) && skeleton.link_length(j) * skeleton.above_scale <= least;
  return on;
}

std::vector<std::vector<int>> links_below(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  const std::vector<bool> on = on_parent(motion);
  std::vector<std::vector<int>> ends(static_cast<std::size_t>(skeleton.size()));
  // Children come after their parents, so a child's list is whole when its parent takes it over.
  for (int j = skeleton.size() - 1; j > 0; --j) {
    auto& above = ends[skeleton.joints[j].parent];
    if (on[j]) {
      above.insert(above.end(), ends[j].begin(), ends[j].end());
    } else {
      above.push_back(j);
    }
  }
  for (auto& list : ends) std::sort(list.begin(), list.end());
  return ends;
}

void aim_links(const Skeleton& skeleton, const std::vector<std::vector<int>>& ends, const WorldMotion& from,
               WorldMotion& to, Work& work) {
  for (int j = 0; j < skeleton.size(); ++j) {
    const auto& below = ends[j];
    const int parent = skeleton.joints[j].parent;
    const auto was = from.position(j), is = std::as_const(to).position(j);
    const auto old = from.orientation(j);
    const auto turned = to.orientation(j);
    const std::size_t frames = to.frames();
    for (std::size_t start = 0; start < frames; start += frames_between_checks) {
      const std::size_t end = std::min(frames, start + frames_between_checks);
      work.check();
      if (below.size() == 1) {
        const auto far_was = from.position(below[0]), far_is = std::as_const(to).position(below[0]);
        for (std::size_t t = start; t < end; ++t)
          turned.set(t, normalized(smallest_turn(far_was[t] - was[t], far_is[t] - is[t]) * old[t]));
      } else if (below.empty() && parent >= 0) {
        const auto near_was = from.position(parent), near_is = std::as_const(to).position(parent);
        for (std::size_t t = start; t < end; ++t)
          turned.set(t, normalized(smallest_turn(was[t] - near_was[t], is[t] - near_is[t]) * old[t]));
      } else {
        std::vector<Vec3> a(below.size()), b(below.size());
        for (std::size_t t = start; t < end; ++t) {
          for (std::size_t i = 0; i < below.size(); ++i) {
            a[i] = from.position(below[i])[t] - was[t];
            b[i] = std::as_const(to).position(below[i])[t] - is[t];
          }
          turned.set(t, normalized(best_turn(a, b) * old[t]));
        }
      }
    }
    make_continuous(turned.x, turned.y, turned.z, turned.w);
  }
}

}  // namespace kinegraph
