#include "nodes/cartoon/limb_swings.h"

#include <algorithm>
#include <utility>

#include "nodes/cartoon/calm.h"
#include "nodes/cartoon/swing_limits.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr double fade_seconds = 0.3;  // around a moment in which a link has no direction
constexpr int most_rounds = 12;
constexpr std::size_t frames_at_once = 16;
constexpr int most_shares = 8;    // rounds of sharing out between links of a limb that stands
constexpr double within = 0.995;  // of what a link may turn, to which it is held

// Sub-joints with their swings: places without them, and what is left of each in every frame.
class Swinging {
 public:
  Swinging(const SubJoints& sub, const FlipWatch& watch, std::vector<Vec3> swing,
           const std::vector<std::vector<double>>& left, double fps, WorldMotion& places)
      : sub_(sub),
        watch_(watch),
        left_(left),
        fps_(fps),
        places_(places),
        count_(sub.all.size()),
        frames_(places.frames()),
        swing_(std::move(swing)) {
    // A step is at most π/2 times the turns of both links together.
    const double most = within * watch.always_allowed();
    const double turn = std::min({most / (1 + pi), swing_room(most, 0) / pi, pi / 2});
    quick_ = cosine(turn) * cosine(turn);
  }

  // Adds all of the swings; whether any link has to be held.
  bool add() {
    held_.assign(count_, 0);
    std::vector<Vec3> still_before(count_), swung_before(count_);
    bool any = false;
    const std::vector<std::size_t> standing = on_parents();
    // A few frames at once, whose swings stay in the cache while the sub-joints take theirs; from the tips
    // up, so that the parent's place is still the one without its swing.
    for (std::size_t start = 0; start < frames_; start += frames_at_once) {
      const std::size_t end = std::min(start + frames_at_once, frames_);
      for (std::size_t i = count_; i-- > 0;) {
        if (!left_[i].empty())
          for (std::size_t t = start; t < end; ++t) swing_[t * count_ + i] *= left_[i][t];
      }
      // What stands on the joint above, always, swings with it.
      for (std::size_t i : standing)
        for (std::size_t t = start; t < end; ++t)
          swing_[t * count_ + i] = swing_[t * count_ + sub_.all[i].parent];
      for (std::size_t i = count_; i-- > 0;) {
        const auto at = places_.position(static_cast<int>(i));
        const int p = sub_.all[i].parent;
        if (p >= 0 && !held_[i] && watch_.watches(static_cast<int>(i))) {
          const auto above = std::as_const(places_).position(p);
          for (std::size_t t = start; t < end; ++t) {
            const Vec3 still = at[t] - above[t];
            const Vec3 swung = still + (swing_[t * count_ + i] - swing_[t * count_ + p]);
            if (points_back(still, swung, watch_.rest_length(static_cast<int>(i))) ||
                (t > 0 && is_quick(still_before[i], swung_before[i], still, swung))) {
              held_[i] = 1;
              any = true;
              break;
            }
            still_before[i] = still;
            swung_before[i] = swung;
          }
        }
        for (std::size_t t = start; t < end; ++t) at.set(t, at[t] + swing_[t * count_ + i]);
      }
    }
    return any;
  }

  // Holds the swing of those links that add() found.
  void hold(Work& work) {
    still_.resize(count_ * frames_);
    for (std::size_t i = 0; i < count_; ++i) {
      const auto at = std::as_const(places_).position(static_cast<int>(i));
      for (std::size_t t = 0; t < frames_; ++t) still_[t * count_ + i] = at[t] - swing_[t * count_ + i];
    }
    const std::vector<Vec3> wished = swing_;
    for (int round = 0; round < most_shares; ++round) {
      work.check();
      if (round > 0) held_ = shared_;
      hold_links();
      if (!share_out(wished)) break;
    }
    put();
  }

  // Where that isn't enough, limbs swing less for a moment.
  void calm(Work& work) {
    std::vector<Calm> calm;
    std::vector<Vec3> whole;
    std::vector<int> children(count_), limb(count_);  // by its first sub-joint below a branching
    for (const SubJoint& one : sub_.all)
      if (one.parent >= 0) ++children[one.parent];
    for (std::size_t i = 0; i < count_; ++i) {
      const int parent = sub_.all[i].parent;
      limb[i] = parent < 0 || children[parent] > 1 ? static_cast<int>(i) : limb[parent];
    }
    for (int round = 0; round < most_rounds; ++round) {
      work.check();
      bool flipped = false;
      for (std::size_t i = 1; i < count_; ++i)
        for (std::size_t t : watch_.flips(places_, static_cast<int>(i))) {
          if (calm.empty()) calm.assign(count_, Calm(frames_, fps_));
          int of = limb[i];
          while (calm[of].is_full(t) && sub_.all[of].parent >= 0) of = limb[sub_.all[of].parent];
          flipped = flipped || !calm[of].is_full(t);
          calm[of].more_at(t);
        }
      if (!flipped) return;
      if (whole.empty()) whole = swing_;
      for (Calm& one : calm) one.settle();
      for (std::size_t i = 0; i < count_; ++i) {
        const int above = sub_.all[limb[i]].parent;
        for (std::size_t t = 0; t < frames_; ++t) {
          const auto rides = [&](const std::vector<Vec3>& all) {
            if (above < 0) return Vec3{};
            return (left_[i].empty() ? 1 : left_[i][t]) * all[t * count_ + above];
          };
          swing_[t * count_ + i] =
              rides(swing_) + calm[limb[i]].left(t) * (whole[t * count_ + i] - rides(whole));
        }
      }
      put();
    }
  }

 private:
  // Sub-joints without a link to the one above, at rest and in every frame.
  std::vector<std::size_t> on_parents() const {
    std::vector<std::size_t> on;
    for (std::size_t i = 1; i < count_; ++i) {
      const int parent = sub_.all[i].parent;
      const double least = 1e-9 * watch_.height();
      if (watch_.rest_length(static_cast<int>(i)) > least) continue;
      const auto at = std::as_const(places_).position(static_cast<int>(i)),
                 above = std::as_const(places_).position(parent);
      bool stands = true;
      for (std::size_t t = 0; t < frames_ && stands; ++t) stands = norm(at[t] - above[t]) <= least;
      if (stands) on.push_back(i);
    }
    return on;
  }

  bool is_quick(Vec3 still_before, Vec3 swung_before, Vec3 still, Vec3 swung) const {
    const auto below = [](Vec3 a, Vec3 b, double cosine_squared) {
      const double along = dot(a, b);
      return along > 0 && along * along > cosine_squared * (dot(a, a) * dot(b, b));
    };
    const double most = watch_.always_allowed();
    if (below(still_before, still, quick_) && below(swung_before, swung, quick_)) return false;
    return swing_step(still_before, swung_before, still, swung) >
           swing_room(within * most,
                      arc_tangent2(norm(cross(still_before, still)), dot(still_before, still)));
  }

  void hold_links() {
    std::vector<Vec3> still(frames_), swung(frames_), before;
    std::vector<double> most(frames_);
    std::vector<Vec3> out = swing_;
    std::vector<char> moved(count_);
    for (std::size_t i = 1; i < count_; ++i) {
      const auto p = static_cast<std::size_t>(sub_.all[i].parent);
      moved[i] = moved[p];
      if (!held_[i] && !moved[i]) continue;
      for (std::size_t t = 0; t < frames_; ++t) {
        still[t] = still_[t * count_ + i] - still_[t * count_ + p];
        swung[t] = still[t] + (swing_[t * count_ + i] - swing_[t * count_ + p]);
      }
      if (held_[i] && needs_hold(still, swung, watch_.rest_length(static_cast<int>(i)))) {
        for (std::size_t t = 1; t < frames_; ++t) most[t] = within * watch_.allowed(static_cast<int>(i), t);
        swung = hold_swing(still, swung, most, watch_.rest_length(static_cast<int>(i)), fade_seconds * fps_);
        moved[i] = 1;
      }
      for (std::size_t t = 0; t < frames_; ++t)
        out[t * count_ + i] = out[t * count_ + p] + (swung[t] - still[t]);
    }
    swing_ = std::move(out);
  }

  bool needs_hold(const std::vector<Vec3>& still, const std::vector<Vec3>& swung, double rest) const {
    for (std::size_t t = 0; t < frames_; ++t)
      if (points_back(still[t], swung[t], rest) ||
          (t > 0 && is_quick(still[t - 1], swung[t - 1], still[t], swung[t])))
        return true;
    return false;
  }

  // Gives back to limbs that stand what holding took from them, by how near they are to where they stand.
  // Whether it does.
  bool share_out(const std::vector<Vec3>& wished) {
    std::vector<char> back(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      if (left_[i].empty()) continue;
      for (std::size_t t = 0; t < frames_; ++t) {
        Vec3& one = swing_[t * count_ + i];
        const Vec3 lost = (1 - left_[i][t]) * (one - wished[t * count_ + i]);
        if (lost == Vec3{}) continue;
        one -= lost;
        back[i] = 1;
      }
    }
    shared_.assign(count_, 0);
    bool any = false;
    for (std::size_t i = 1; i < count_; ++i) {
      shared_[i] = watch_.watches(static_cast<int>(i)) && (back[i] || back[sub_.all[i].parent]);
      any = any || shared_[i];
    }
    return any;
  }

  void put() {
    for (std::size_t i = 0; i < count_; ++i) {
      const auto at = places_.position(static_cast<int>(i));
      for (std::size_t t = 0; t < frames_; ++t) at.set(t, still_[t * count_ + i] + swing_[t * count_ + i]);
    }
  }

  const SubJoints& sub_;
  const FlipWatch& watch_;
  const std::vector<std::vector<double>>& left_;
  double fps_;
  WorldMotion& places_;
  std::size_t count_, frames_;
  double quick_ = 0;  // cosine², of a turn under which nothing needs a closer look
  std::vector<Vec3> swing_, still_;
  std::vector<char> held_, shared_;
};

}  // namespace

void add_swings(const SubJoints& sub, const FlipWatch& watch, std::vector<Vec3> swing,
                const std::vector<std::vector<double>>& left, double fps, WorldMotion& places, Work& work) {
  Swinging swinging(sub, watch, std::move(swing), left, fps, places);
  if (!swinging.add()) return;
  swinging.hold(work);
  swinging.calm(work);
}

}  // namespace kinegraph
