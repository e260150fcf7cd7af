#include "nodes/cartoon/sub_joint_turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nodes/cartoon/link_turns.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/track_kernels.h"

namespace kinegraph {
namespace {

// What it costs to go the long way round: seconds times part of a turn beyond the half, with five times as
// much beyond `far`, where the sub-joints between begin to spin; and to change the way.
constexpr double far = 300 / degrees_per_radian, cost_of_far = 5, cost_of_change = 0.1;
// Of the turn between a joint and its child, a second: 20° a frame at 120.
constexpr double most_a_second = 20 * 120 / degrees_per_radian;

double cost_of(double angle, double seconds) {
  double cost = std::max(0.0, angle - pi);
  if (angle > far) cost += cost_of_far * (angle - far);
  return cost / (2 * pi) * seconds;
}

// For each frame, whether to take −q of the short q: the cheapest way through time.
std::vector<bool> long_ways(std::span<const Quat> shorts, double seconds) {
  const std::size_t count = shorts.size();
  std::vector<std::array<char, 2>> from(count);  // the state before, for either state
  double cost[2] = {0, cost_of(2 * pi - 2 * norm(log(shorts[0])), seconds)};
  for (std::size_t t = 1; t < count; ++t) {
    const double along = dot(shorts[t - 1], shorts[t]);
    const double same = cost_of_change * std::max(0.0, -along), other = cost_of_change * std::max(0.0, along);
    const double here[2] = {0, cost_of(2 * pi - 2 * norm(log(shorts[t])), seconds)};
    double next[2];
    for (int way = 0; way < 2; ++way) {
      const double stay = cost[way] + same, change = cost[1 - way] + other;
      from[t][way] = static_cast<char>(stay <= change ? way : 1 - way);
      next[way] = std::min(stay, change) + here[way];
    }
    cost[0] = next[0];
    cost[1] = next[1];
  }
  std::vector<bool> longs(count);
  int way = cost[1] < cost[0] ? 1 : 0;
  for (std::size_t t = count; t-- > 0;) {
    longs[t] = way == 1;
    if (t > 0) way = from[t][way];
  }
  return longs;
}

// Midway between following forwards and backwards.
void hold_steps(std::vector<Vec3>& values, double most) {
  const auto follow = [most](Vec3 from, Vec3 to) {
    const double far_off = norm(to - from);
    return far_off > most ? from + (most / far_off) * (to - from) : to;
  };
  std::vector<Vec3> backward = values;
  for (std::size_t t = values.size(); t-- > 1;) backward[t - 1] = follow(backward[t], backward[t - 1]);
  for (std::size_t t = 1; t < values.size(); ++t) values[t] = follow(values[t - 1], values[t]);
  for (std::size_t t = 0; t < values.size(); ++t) values[t] = 0.5 * (values[t] + backward[t]);
}

class Turning {
 public:
  Turning(const Skeleton& skeleton, const SubJoints& sub, const std::vector<std::vector<int>>& ends,
          const WorldMotion& world, double fps, const std::vector<Vec3>& axes, WorldMotion& places)
      : skeleton_(skeleton),
        sub_(sub),
        ends_(ends),
        world_(world),
        fps_(fps),
        limits_(turn_limits(fps)),
        axes_(axes),
        rest_(rest_pose(skeleton)),
        places_(places) {}

  void turn_all(Work& work) {
    for (int k = 0; k < skeleton_.size(); ++k) {
      work.check();
      turn_first(k);
    }
    for (int k = 0; k < skeleton_.size(); ++k) {
      work.check();
      if (sub_.all[sub_.first[k]].count > 1) turn_rest(k);
    }
  }

 private:
  ConstVec3Track place(int sub) const { return std::as_const(places_).position(sub); }

  void aim(int k, int from_joint, int to_joint, int from_sub, int to_sub) {
    aim_link(rest_link(rest_, k, from_joint, to_joint), world_.position(from_joint),
             world_.position(to_joint), place(from_sub), place(to_sub), world_.orientation(k), limits_,
             places_.orientation(sub_.first[k]));
  }

  void turn_first(int k) {
    const int own = sub_.first[k];
    const SubJoint& first = sub_.all[own];
    const auto& below = ends_[k];
    const int parent = skeleton_.joints[k].parent;
    if (first.count > 1) {
      aim(k, k, first.next, own, own + 1);
    } else if (below.size() == 1) {
      aim(k, k, below[0], own, sub_.first[below[0]]);
    } else if (below.empty() && parent >= 0) {
      aim(k, parent, k, sub_.first[parent], own);
    } else {
      std::vector<Vec3> axes;
      std::vector<ConstVec3Track> old_ends, ends;
      for (int end : below) {
        axes.push_back(rest_link(rest_, k, k, end));
        old_ends.push_back(world_.position(end));
        ends.push_back(place(sub_.first[end]));
      }
      aim_branch(axes, world_.position(k), old_ends, place(own), ends, world_.orientation(k), limits_,
                 places_.orientation(own));
    }
  }

  void turn_rest(int k) {
    const int own = sub_.first[k];
    const SubJoint& first = sub_.all[own];
    const auto from = std::as_const(places_).orientation(own);
    const auto to = std::as_const(places_).orientation(sub_.first[first.next]);
    std::vector<Quat> between(world_.frames());
    // Of the two joints' turns from rest: frames of a rig may stand half a turn apart, and mean nothing by
    // it.
    const Quat apart = inverse(inverse(rest_.orientations[k]) * rest_.orientations[first.next]);
    for (std::size_t t = 0; t < between.size(); ++t) between[t] = inverse(from[t]) * to[t] * apart;
    const std::vector<Vec3> turns = followed_turns(between, 1 / fps_, most_a_second / fps_);
    std::vector<QuatTrack> out;
    for (int l = 1; l < first.count; ++l) out.push_back(places_.orientation(own + l));
    std::vector<double> room(4 * turns.size());
    const auto series = [&](std::size_t n) {
      return std::span(room).subspan(n * turns.size(), turns.size());
    };
    const QuatTrack part{series(0), series(1), series(2), series(3)};
    for (std::size_t t = 0; t < turns.size(); ++t) part.set(t, exp((1.0 / first.count) * turns[t]));
    for (int l = 1; l < first.count; ++l)
      multiply_tracks(std::as_const(places_).orientation(own + l - 1), false,
                      {part.x, part.y, part.z, part.w}, out[static_cast<std::size_t>(l - 1)]);
    if (axes_.empty()) return;
    const int next = first.next;
    std::vector<InputTwist> inputs{{world_.orientation(k), rest_link(rest_, k, k, next)}};
    if (ends_[next].size() == 1)
      inputs.push_back({world_.orientation(next), rest_link(rest_, next, next, ends_[next][0])});
    for (int l = 1; l < first.count; ++l)
      limit_twist(axes_[own + l], inputs, limits_, out[static_cast<std::size_t>(l - 1)]);
  }

  const Skeleton& skeleton_;
  const SubJoints& sub_;
  const std::vector<std::vector<int>>& ends_;
  const WorldMotion& world_;
  double fps_;
  TurnLimits limits_;
  const std::vector<Vec3>& axes_;
  RestPose rest_;
  WorldMotion& places_;
};

}  // namespace

std::vector<Vec3> followed_turns(std::span<const Quat> turns, double seconds, double most) {
  std::vector<Quat> ways(turns.size());
  bool passes = false;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    ways[t] = nearer(turns[t], Quat{});
    passes = passes || (t > 0 && dot(ways[t - 1], ways[t]) < 0);
  }
  if (passes) {
    const std::vector<bool> longs = long_ways(ways, seconds);
    for (std::size_t t = 0; t < ways.size(); ++t)
      if (longs[t]) ways[t] = -ways[t];
  }
  std::vector<Vec3> halves(turns.size());
  bool jumps = false;
  for (std::size_t t = 0; t < ways.size(); ++t) {
    halves[t] = log(ways[t]);
    if (t == 0) continue;
    const Vec3 step = halves[t] - halves[t - 1];
    jumps = jumps || dot(step, step) > 0.25 * most * most;
  }
  if (jumps) hold_steps(halves, 0.5 * most);
  return halves;
}

void turn_sub_joints(const Skeleton& skeleton, const SubJoints& sub,
                     const std::vector<std::vector<int>>& ends, const WorldMotion& world, double fps,
                     const std::vector<Vec3>& axes, WorldMotion& places, Work& work) {
  Turning(skeleton, sub, ends, world, fps, axes, places).turn_all(work);
}

}  // namespace kinegraph
