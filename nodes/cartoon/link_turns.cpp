#include "nodes/cartoon/link_turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr double hold_to_identity = 0.005;  // of the links' squared length, about each axis
constexpr double zero_link = 1e-6;          // of the height
// 5° a frame at 120 frames a second.
constexpr double most_twist_a_second = 5 * 120 / degrees_per_radian;

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

void limit_turns(ConstQuatTrack old, double most_turn, QuatTrack out) {
  const std::size_t frames = out.w.size();
  // Of unit quaternions half an angle apart |a·b| is its cosine.
  const double least_cosine = cosine(0.5 * most_turn);
  std::vector<Quat> turned(frames);
  bool jumps = false;
  for (std::size_t t = 0; t < frames; ++t) {
    turned[t] = inverse(old[t]) * out[t];
    jumps = jumps || (t > 0 && std::fabs(dot(turned[t], turned[t - 1])) < least_cosine);
  }
  if (jumps) {
    const auto follow = [&](Quat from, Quat to) {
      const double angle = turn(from, to);
      return angle > most_turn ? slerp(most_turn / angle, from, to) : to;
    };
    std::vector<Quat> forward = turned, backward = turned;
    for (std::size_t t = 1; t < frames; ++t) forward[t] = follow(forward[t - 1], turned[t]);
    for (std::size_t t = frames - 1; t-- > 0;) backward[t] = follow(backward[t + 1], turned[t]);
    for (std::size_t t = 0; t < frames; ++t)
      out.set(t, normalized(old[t] * slerp(0.5, forward[t], backward[t])));
  }
  make_continuous(out.x, out.y, out.z, out.w);
}

double most_twist_at(double fps) {
  return most_twist_a_second / fps;
}

void aim_link(ConstVec3Track old_from, ConstVec3Track old_to, ConstVec3Track from, ConstVec3Track to,
              ConstQuatTrack old, double most_twist, QuatTrack out) {
  const std::size_t frames = out.w.size();
  for (std::size_t t = 0; t < frames; ++t)
    out.set(t, normalized(smallest_turn(old_to[t] - old_from[t], to[t] - from[t]) * old[t]));
  make_continuous(out.x, out.y, out.z, out.w);
  // The twist of both from frame to frame, as half-angle cosine and sine, about the link in the joint's
  // frame.
  const double tangent = sine(0.5 * most_twist) / cosine(0.5 * most_twist);
  const auto axis = [&](std::size_t t) {
    return normalized(rotate(inverse(old[t]), old_to[t] - old_from[t]));
  };
  const auto excess = [&](std::size_t t, double& s, double& c) {
    const Vec3 a = axis(t);
    const Quat step = inverse(out[t - 1]) * out[t], input = inverse(old[t - 1]) * old[t];
    const double s1 = dot(a, Vec3{step.x, step.y, step.z}), s2 = dot(a, Vec3{input.x, input.y, input.z});
    s = s1 * input.w - step.w * s2;
    c = step.w * input.w + s1 * s2;
    if (c < 0) {
      c = -c;
      s = -s;
    }
  };
  bool spins = false;
  double s, c;
  for (std::size_t t = 1; t < frames && !spins; ++t) {
    excess(t, s, c);
    spins = std::fabs(s) > tangent * c;
  }
  if (!spins) return;
  std::vector<double> twist(frames), low(frames), high(frames);
  for (std::size_t t = 1; t < frames; ++t) {
    excess(t, s, c);
    twist[t] = twist[t - 1] + 2 * arc_tangent2(s, c);
  }
  low = high = twist;
  for (std::size_t t = 1; t < frames; ++t) {
    low[t] = std::max(low[t], low[t - 1] - most_twist);
    high[t] = std::min(high[t], high[t - 1] + most_twist);
  }
  for (std::size_t t = frames - 1; t-- > 0;) {
    low[t] = std::max(low[t], low[t + 1] - most_twist);
    high[t] = std::min(high[t], high[t + 1] + most_twist);
  }
  for (std::size_t t = 0; t < frames; ++t)
    out.set(t, normalized(out[t] * axis_angle(axis(t), 0.5 * (low[t] + high[t]) - twist[t])));
  make_continuous(out.x, out.y, out.z, out.w);
}

void aim_links(const Skeleton& skeleton, const std::vector<std::vector<int>>& ends, const WorldMotion& from,
               double most_twist, WorldMotion& to, Work& work) {
  for (int j = 0; j < skeleton.size(); ++j) {
    work.check();
    const auto& below = ends[j];
    const int parent = skeleton.joints[j].parent;
    const auto is = [&](int joint) { return std::as_const(to).position(joint); };
    const auto turned = to.orientation(j);
    const auto old = from.orientation(j);
    if (below.size() == 1) {
      aim_link(from.position(j), from.position(below[0]), is(j), is(below[0]), old, most_twist, turned);
    } else if (below.empty() && parent >= 0) {
      aim_link(from.position(parent), from.position(j), is(parent), is(j), old, most_twist, turned);
    } else {
      std::vector<Vec3> a(below.size()), b(below.size());
      for (std::size_t t = 0; t < to.frames(); ++t) {
        for (std::size_t i = 0; i < below.size(); ++i) {
          a[i] = from.position(below[i])[t] - from.position(j)[t];
          b[i] = is(below[i])[t] - is(j)[t];
        }
        turned.set(t, normalized(best_turn(a, b) * old[t]));
      }
      limit_turns(old, most_twist, turned);
    }
  }
}

}  // namespace kinegraph
