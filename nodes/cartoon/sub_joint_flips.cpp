#include "nodes/cartoon/sub_joint_flips.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/cartoon/planted_limbs.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/track_kernels.h"

namespace kinegraph {
namespace {

constexpr double most_a_second = 29.5 * 120 / degrees_per_radian;
constexpr double times_input = 1.99;  // or that many times the turn of the joints' own link
constexpr double free_below = 0.2;    // of a link's rest length
constexpr double least_link = 1e-3;   // of the height: a shorter one has no direction to speak of
constexpr double fade_seconds = 0.3;  // in which a limb is calmed and let go again
constexpr int most_rounds = 12;
constexpr std::size_t frames_at_once = 16;
constexpr double calm_enough = 0.9;  // more than that is all

double angle_between(Vec3 a, Vec3 b) {
  return arc_tangent2(norm(cross(a, b)), dot(a, b));
}

// How much of its liveliness something has lost, at every frame.
class Calm {
 public:
  Calm(std::size_t frames, double fps) : lost_(frames), fade_(std::max(fade_seconds * fps, 1.0)) {}

  bool any() const { return any_; }
  double left(std::size_t frame) const { return 1 - lost_[frame]; }
  // Of all, from frame − 1 to frame.
  bool is_full(std::size_t frame) const { return lost_[frame] >= 1 && lost_[frame - 1] >= 1; }

  // Half of what is left goes from frame − 1 to frame.
  void more_at(std::size_t frame) {
    double size = 0.5 * (1 + lost_[frame]);
    if (size > calm_enough) size = 1;
    const auto reach = static_cast<std::size_t>(fade_) + 1;
    const std::size_t first = frame > reach ? frame - reach : 0;
    for (std::size_t t = first; t < std::min(frame + reach, lost_.size()); ++t) {
      const double away = t >= frame ? static_cast<double>(t - frame) : static_cast<double>(frame - 1 - t);
      wanted_.emplace_back(t, size * smoothest_step(1 - away / fade_));
    }
    any_ = true;
  }
  void settle() {
    for (const auto& [t, size] : wanted_) lost_[t] = std::max(lost_[t], size);
    wanted_.clear();
  }

 private:
  std::vector<double> lost_;
  std::vector<std::pair<std::size_t, double>> wanted_;
  double fade_;
  bool any_ = false;
};

}  // namespace

FlipWatch::FlipWatch(const SubJoints& sub, const Skeleton& rubber, const WorldMotion& world, double fps)
    : sub_(sub), world_(world), most_(std::min(most_a_second / fps, pi)) {
  const double least = least_link * rest_height(rubber);
  for (int i = 0; i < rubber.size(); ++i) {
    parents_.push_back(rubber.joints[i].parent);
    const double rest = rubber.link_length(i) * rubber.above_scale;
    shortest_squared_.push_back(i > 0 && rest > least ? free_below * free_below * rest * rest : -1);
  }
}

// What Exaggerate lets pass is either below `most_` or a share of what its own input turned, of which as much
// again is left.
double FlipWatch::allowed(int i, std::size_t t) const {
  const SubJoint &lower = sub_.all[i], &upper = sub_.all[parents_[i]];
  const int from = upper.joint, to = lower.step == 0 ? lower.joint : upper.next;
  const auto a = world_.position(from), b = world_.position(to);
  const double input = angle_between(b[t - 1] - a[t - 1], b[t] - a[t]);
  return input > most_ ? times_input * input : most_;
}

std::vector<std::size_t> FlipWatch::flips(const WorldMotion& places, int i) const {
  std::vector<std::size_t> frames;
  const double shortest = shortest_squared_[i];
  if (shortest < 0) return frames;
  const double cosine_squared = most_ < pi / 2 ? cosine(most_) * cosine(most_) : 2;
  const auto child = places.position(i), parent = places.position(parents_[i]);
  const auto next = [&](std::size_t start) {
    return next_turn_beyond(parent, child, cosine_squared, shortest, start);
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

void add_swings(const SubJoints& sub, const FlipWatch& watch, std::vector<Vec3> swing,
                const std::vector<std::vector<double>>& left, double fps, WorldMotion& places, Work& work) {
  const std::size_t count = sub.all.size(), frames = places.frames();
  // The limb a sub-joint is in, by its first sub-joint below a branching.
  std::vector<int> children(count), limb(count);
  for (const SubJoint& one : sub.all)
    if (one.parent >= 0) ++children[one.parent];
  for (std::size_t i = 0; i < count; ++i) {
    const int parent = sub.all[i].parent;
    limb[i] = parent < 0 || children[parent] > 1 ? static_cast<int>(i) : limb[parent];
  }
  std::vector<char> changed(count, 1);
  std::vector<Vec3> still;  // before any swing; kept once something flips
  const auto put = [&](bool again) {
    // A few frames at once, whose swings stay in the cache while the sub-joints take theirs.
    for (std::size_t start = 0; start < frames; start += frames_at_once) {
      const std::size_t end = std::min(start + frames_at_once, frames);
      for (std::size_t i = 0; i < count; ++i) {
        if (!changed[i]) continue;
        const auto at = places.position(static_cast<int>(i));
        for (std::size_t t = start; t < end; ++t) {
          const double part = left[i].empty() ? 1 : left[i][t];
          at.set(t, (again ? still[t * count + i] : at[t]) + part * swing[t * count + i]);
        }
      }
    }
  };
  put(false);
  std::vector<Calm> calm;
  std::vector<Vec3> whole;
  for (int round = 0; round < most_rounds; ++round) {
    work.check();
    bool flipped = false;
    std::vector<char> calmed(count);
    for (std::size_t i = 1; i < count; ++i) {
      if (!changed[i] && !changed[sub.all[i].parent]) continue;
      for (std::size_t t : watch.flips(places, static_cast<int>(i))) {
        if (calm.empty()) calm.assign(count, Calm(frames, fps));
        int of = limb[i];
        while (calm[of].is_full(t) && sub.all[of].parent >= 0) of = limb[sub.all[of].parent];
        flipped = flipped || !calm[of].is_full(t);
        calm[of].more_at(t);
        calmed[of] = 1;
      }
    }
    if (!flipped) return;
    if (still.empty()) {
      still.resize(count * frames);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t t = 0; t < frames; ++t) {
          const double part = left[i].empty() ? 1 : left[i][t];
          still[t * count + i] =
              std::as_const(places).position(static_cast<int>(i))[t] - part * swing[t * count + i];
        }
      whole = swing;
    }
    for (Calm& one : calm) one.settle();
    for (std::size_t i = 0; i < count; ++i) {
      const int above = sub.all[limb[i]].parent;
      changed[i] = calmed[limb[i]] || (above >= 0 && changed[above]);
      if (!changed[i]) continue;
      for (std::size_t t = 0; t < frames; ++t) {
        const Vec3 rides = above < 0 ? Vec3{} : swing[t * count + above];
        const Vec3 own = whole[t * count + i] - (above < 0 ? Vec3{} : whole[t * count + above]);
        swing[t * count + i] = rides + calm[limb[i]].left(t) * own;
      }
    }
    put(true);
  }
}

}  // namespace kinegraph
