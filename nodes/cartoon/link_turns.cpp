#include "nodes/cartoon/link_turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nodes/motion/elementary.h"
#include "nodes/motion/track_kernels.h"

namespace kinegraph {
namespace {

constexpr int most_rounds = 10;

constexpr double hold_to_identity = 0.005;  // of the links' squared length, about each axis
constexpr double zero_link = 1e-5;          // of the height

constexpr double one_direction = 1 - 4e-15;  // of the trace of a square

using Matrix4 = std::array<std::array<double, 4>, 4>;

// Squares a symmetric matrix and brings it to trace 1. Returns the trace of the square of one of trace 1: 1
// where it has one direction.
double squared(Matrix4& m) {
  const double before = m[0][0] + m[1][1] + m[2][2] + m[3][3];
  Matrix4 out;
  for (int r = 0; r < 4; ++r)
    for (int c = r; c < 4; ++c)
      out[r][c] = m[r][0] * m[c][0] + m[r][1] * m[c][1] + m[r][2] * m[c][2] + m[r][3] * m[c][3];
  const double trace = out[0][0] + out[1][1] + out[2][2] + out[3][3], inverse = 1 / trace;
  for (int r = 0; r < 4; ++r)
    for (int c = r; c < 4; ++c) m[r][c] = m[c][r] = inverse * out[r][c];
  return trace / (before * before);
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
  // Horn's matrix, rows w x y z; its dominant eigenvector is the rotation. Shifted to be positive and squared
  // until nothing but that direction is left: by the 4096th power at the latest.
  Matrix4 n;
  n[0] = {s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]};
  n[1] = {n[0][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]};
  n[2] = {n[0][2], n[1][2], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]};
  n[3] = {n[0][3], n[1][3], n[2][3], s[2][2] - s[0][0] - s[1][1]};
  for (int i = 0; i < 4; ++i) n[i][i] += bound;
  for (int round = 0; round < 12; ++round)
    if (squared(n) > one_direction) break;
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

Vec3 rest_link(const RestPose& rest, int of, int from, int to) {
  return normalized(rotate(inverse(rest.orientations[of]), rest.positions[to] - rest.positions[from]));
}

void aim_branch(std::span<const Vec3> axes, ConstVec3Track old_at, std::span<const ConstVec3Track> old_ends,
                ConstVec3Track at, std::span<const ConstVec3Track> ends, ConstQuatTrack old,
                const TurnLimits& limits, QuatTrack out) {
  const std::size_t frames = out.w.size(), count = ends.size();
  std::vector<Vec3> a(count), b(count);
  std::vector<Quat> turned(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    for (std::size_t i = 0; i < count; ++i) {
      a[i] = old_ends[i][t] - old_at[t];
      b[i] = ends[i][t] - at[t];
    }
    turned[t] = best_turn(a, b);
    out.set(t, normalized(turned[t] * old[t]));
  }
  // Where the turn between input and result stays, the result twists as the input does.
  const double quick = cosine(0.5 * limits.twist_departure), quick_out = cosine(0.5 * limits.twist);
  const auto twist_of = [&](Quat step, std::size_t i) { return std::fabs(HalfTwist(step, axes[i]).angle()); };
  std::vector<double> most(frames, limits.twist_departure);
  bool jumps = false;
  for (std::size_t t = 1; t < frames; ++t) {
    const double apart = std::fabs(dot(turned[t - 1], turned[t]));
    if (apart < quick) jumps = true;
    if (std::fabs(dot(out[t - 1], out[t])) >= quick_out) continue;
    double input = 0;
    for (std::size_t i = 0; i < count; ++i)
      input = std::max(input, twist_of(inverse(old[t - 1]) * old[t], i));
    most[t] = std::clamp(limits.twist - input, 0.0, limits.twist_departure);
    jumps = jumps || apart < cosine(0.5 * most[t]);
  }
  // A departure across a quick swing twists by more than itself: there it gets less.
  const std::vector<Quat> wished = turned;
  for (int round = 0; jumps && round < most_rounds; ++round) {
    turned = with_turns_within(wished, most);
    for (std::size_t t = 0; t < frames; ++t) out.set(t, normalized(turned[t] * old[t]));
    jumps = false;
    for (std::size_t t = 1; t < frames; ++t) {
      if (std::fabs(dot(out[t - 1], out[t])) >= quick_out || most[t] == 0) continue;
      for (std::size_t i = 0; i < count; ++i) {
        if (twist_of(inverse(out[t - 1]) * out[t], i) <=
            std::max(limits.twist, twist_of(inverse(old[t - 1]) * old[t], i)))
          continue;
        most[t] = round + 2 < most_rounds ? 0.5 * most[t] : 0;
        jumps = true;
        break;
      }
    }
  }
  make_continuous(out.x, out.y, out.z, out.w);
}

void aim_link(Vec3 axis, ConstVec3Track old_from, ConstVec3Track old_to, ConstVec3Track from,
              ConstVec3Track to, ConstQuatTrack old, const TurnLimits& limits, QuatTrack out) {
  const std::size_t frames = out.w.size();
  std::vector<double> room(4 * frames);
  const auto series = [&](std::size_t n) { return std::span(room).subspan(n * frames, frames); };
  const QuatTrack turned{series(0), series(1), series(2), series(3)};
  const ConstQuatTrack as_turned{turned.x, turned.y, turned.z, turned.w};
  const ConstQuatTrack as_out{out.x, out.y, out.z, out.w};
  smallest_turns(old_from, old_to, from, to, turned);
  if (next_step_below(as_turned, cosine(0.5 * limits.turn_departure), 1) < frames) {
    std::vector<Quat> turns(frames);
    std::vector<double> most(frames);
    for (std::size_t t = 0; t < frames; ++t) {
      turns[t] = turned[t];
      if (t > 0) most[t] = limits.turn_departure + turn(old[t - 1], old[t]);
    }
    turns = with_turns_within(turns, most);
    for (std::size_t t = 0; t < frames; ++t) turned.set(t, turns[t]);
  }
  multiply_tracks(as_turned, false, old, out);
  make_continuous(out.x, out.y, out.z, out.w);
  const HalfTwist most(limits.twist), departure(limits.twist_departure);
  // Most frames need no closer look: the rotation between input and result hardly changes.
  const double quick = cosine(0.25 * limits.twist_departure), quick_out = cosine(0.5 * limits.twist);
  const auto next_quick = [&](std::size_t start) {
    return std::min(next_step_below(as_turned, quick, start), next_step_below(as_out, quick_out, start));
  };
  bool spins = false;
  for (std::size_t t = next_quick(1); t < frames && !spins; t = next_quick(t + 1)) {
    const HalfTwist is(inverse(out[t - 1]) * out[t], axis), input(inverse(old[t - 1]) * old[t], axis);
    spins = is.beyond(input).exceeds(departure) || (is.exceeds(most) && is.exceeds(input));
  }
  if (!spins) return;
  std::vector<double> twist(frames), fewest(frames), largest(frames);
  for (std::size_t t = 1; t < frames; ++t) {
    const HalfTwist is(inverse(out[t - 1]) * out[t], axis), input(inverse(old[t - 1]) * old[t], axis);
    const double own = input.angle(), bound = std::max(limits.twist, std::fabs(own));
    twist[t] = twist[t - 1] + own + is.beyond(input).angle();
    fewest[t] = std::max(own - limits.twist_departure, -bound);
    largest[t] = std::min(own + limits.twist_departure, bound);
  }
  const std::vector<double> held = with_steps_between(twist, fewest, largest);
  for (std::size_t t = 0; t < frames; ++t)
    if (held[t] != twist[t]) out.set(t, normalized(out[t] * axis_angle(axis, held[t] - twist[t])));
  make_continuous(out.x, out.y, out.z, out.w);
}

void aim_links(const Skeleton& skeleton, const std::vector<std::vector<int>>& ends, const WorldMotion& from,
               const TurnLimits& limits, WorldMotion& to, Work& work) {
  const RestPose rest = rest_pose(skeleton);
  for (int j = 0; j < skeleton.size(); ++j) {
    work.check();
    const auto& below = ends[j];
    const int parent = skeleton.joints[j].parent;
    const auto is = [&](int joint) { return std::as_const(to).position(joint); };
    const auto turned = to.orientation(j);
    const auto old = from.orientation(j);
    if (below.size() == 1) {
      aim_link(rest_link(rest, j, j, below[0]), from.position(j), from.position(below[0]), is(j),
               is(below[0]), old, limits, turned);
    } else if (below.empty() && parent >= 0) {
      aim_link(rest_link(rest, j, parent, j), from.position(parent), from.position(j), is(parent), is(j), old,
               limits, turned);
    } else {
      std::vector<Vec3> axes;
      std::vector<ConstVec3Track> old_ends, ends_now;
      for (int end : below) {
        axes.push_back(rest_link(rest, j, j, end));
        old_ends.push_back(from.position(end));
        ends_now.push_back(is(end));
      }
      aim_branch(axes, from.position(j), old_ends, is(j), ends_now, old, limits, turned);
    }
  }
}

}  // namespace kinegraph
