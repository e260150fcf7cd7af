#include "nodes/cartoon/sub_joint_flips.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/cartoon/calm.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/track_kernels.h"

namespace kinegraph {
namespace {

constexpr double most_a_second = 29.5 * 120 / degrees_per_radian;
constexpr double times_input = 1.99;  // or that many times the turn of the joints' own link
constexpr double free_below = 0.2;    // of a link's rest length
constexpr double least_link = 1e-3;   // of the height: a shorter one has no direction to speak of
constexpr int most_rounds = 12;

double angle_between(Vec3 a, Vec3 b) {
  return arc_tangent2(norm(cross(a, b)), dot(a, b));
}

}  // namespace

FlipWatch::FlipWatch(const SubJoints& sub, const Skeleton& rubber, const WorldMotion& world, double fps)
    : sub_(sub), world_(world), most_(std::min(most_a_second / fps, pi)) {
  cosine_squared_ = most_ < pi / 2 ? cosine(most_) * cosine(most_) : 2;
  height_ = rest_height(rubber);
  const double least = least_link * height_;
  for (int i = 0; i < rubber.size(); ++i) {
    parents_.push_back(rubber.joints[i].parent);
    const double rest = rubber.link_length(i) * rubber.above_scale;
    rest_.push_back(rest);
    shortest_squared_.push_back(i > 0 && rest > least ? free_below * free_below * rest * rest : -1);
  }
}

// What Exaggerate lets pass is either below `most_` or a share of what its own input turned, of which as much
// again is left.
double FlipWatch::allowed(int i, std::size_t t) const {
  const SubJoint &lower = sub_.all[i], &upper = sub_.all[parents_[i]];
  const int from = upper.joint, to = lower.step == 0 ? lower.joint : upper.next;
  const auto a = world_.position(from), b = world_.position(to);
  const Vec3 before = b[t - 1] - a[t - 1], now = b[t] - a[t];
  const double along = dot(before, now);
  if (along > 0 && along * along > cosine_squared_ * (dot(before, before) * dot(now, now))) return most_;
  const double input = angle_between(before, now);
  return input > most_ ? times_input * input : most_;
}

std::vector<std::size_t> FlipWatch::flips(const WorldMotion& places, int i) const {
  std::vector<std::size_t> frames;
  const double shortest = shortest_squared_[i];
  if (shortest < 0) return frames;
  const auto child = places.position(i), parent = places.position(parents_[i]);
  const auto next = [&](std::size_t start) {
    return next_turn_beyond(parent, child, cosine_squared_, shortest, start);
  };
  for (std::size_t t = next(1); t < places.frames(); t = next(t + 1))
    if (angle_between(child[t - 1] - parent[t - 1], child[t] - parent[t]) > allowed(i, t))
      frames.push_back(t);
  return frames;
}

void straighten_flips(const SubJoints& sub, const FlipWatch& watch, const WorldMotion& world, double fps,
                      WorldMotion& places, Work& work) {
  for (const auto& group : sub.groups) {
    Calm calm(places.frames(), fps);
    std::vector<std::vector<Vec3>> from;  // each sub-joint of the curve, on the curve
    const auto each = [&](const auto& act) {
      for (std::size_t n = 0; n + 1 < group.size(); ++n) {
        const int first = sub.first[group[n]];
        for (int l = 1; l < sub.all[first].count; ++l) act(n, first + l);
      }
    };
    for (int round = 0; round < most_rounds; ++round) {
      work.check();
      bool flipped = false;
      const auto look = [&](int i) {
        for (std::size_t t : watch.flips(places, i)) {
          flipped = flipped || !calm.is_full(t);
          calm.more_at(t);
        }
      };
      for (std::size_t n = 0; n + 1 < group.size(); ++n) {
        const SubJoint& first = sub.all[sub.first[group[n]]];
        for (int l = 1; l < first.count; ++l) look(sub.first[group[n]] + l);
        look(sub.first[group[n + 1]]);
      }
      if (!flipped) break;
      calm.settle();
      if (from.empty())
        each([&](std::size_t, int i) {
          from.emplace_back();
          for (std::size_t t = 0; t < places.frames(); ++t)
            from.back().push_back(std::as_const(places).position(i)[t]);
        });
      std::size_t at = 0;
      each([&](std::size_t n, int i) {
        const auto a = world.position(group[n]), b = world.position(group[n + 1]);
        const double part = sub.all[i].part();
        const auto out = places.position(i);
        const std::vector<Vec3>& curve = from[at++];
        for (std::size_t t = 0; t < places.frames(); ++t) {
          const Vec3 straight = (1 - part) * a[t] + part * b[t];
          if (calm.left(t) < 1) out.set(t, straight + calm.left(t) * (curve[t] - straight));
        }
      });
    }
  }
}

}  // namespace kinegraph
