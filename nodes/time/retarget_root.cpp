#include "nodes/time/retarget_root.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// Heel and ball of one leg on both sides.
struct Feet {
  std::array<std::vector<double>, 2> source_height, target_height;  // world; the target's with its hips at 0
  std::array<bool, 2> known{};
  // How much higher each stands than the ball, or the ankle where no ball is known, with the sole flat.
  std::array<double, 2> source_stands{}, target_stands{};
  double target_footing = 0;  // world height of that ball or ankle as the target stands
  std::size_t footing() const { return known[1] ? 1 : 0; }
};

double low_of(std::vector<double> heights) {
  const auto tenth = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
  std::nth_element(heights.begin(), tenth, heights.end());
  return *tenth;
}

// Index of the body's leg on a side; their number: none.
std::size_t leg_on(const Body& body, bool left) {
  const auto found =
      std::find_if(body.legs.begin(), body.legs.end(), [&](const Leg& leg) { return leg.left == left; });
  return static_cast<std::size_t>(found - body.legs.begin());
}

bool has_legs(const JointPairs& pairs) {
  return pairs.source.legs.size() == 2 && pairs.target.legs.size() == 2;
}

// The middle of the hips, where both bodies have them; else the pelvis.
template <class At>
Vec3 hips_at(const Body& body, int pelvis, bool legs, const At& at) {
  return legs ? 0.5 * (at(body.legs[0].hip) + at(body.legs[1].hip)) : at(pelvis);
}

double ball_height(const Leg& leg, const WorldMotion& world, std::size_t t) {
  if (leg.toe >= 0) return world.position(leg.toe)[t].y;
  return point_at(world, leg.ankle, *leg.toe_tip, t).y;
}

// Where the ground is under both bodies, and how the target's hips go over it.
struct Path {
  std::vector<Vec3> hips;    // world
  double ground = 0;         // under the motion, where its feet show one
  double target_ground = 0;  // under the target as it stands
};

class Placing {
 public:
  Placing(const RootSource& source, const RootTarget& target, const JointPairs& pairs, const Motion& motion,
          Work& work)
      : source_(source),
        target_(target),
        pairs_(pairs),
        legs_(has_legs(pairs)),
        sole_(target.stands->frame ? std::nullopt : target.sole),
        frames_(motion.frames()),
        world_(world_motion(motion, work)) {}

  double own_scale() const {
    double a = legs_ ? leg_length(*source_.skeleton) : 0, b = legs_ ? leg_length(*target_.skeleton) : 0;
    if (a <= 0 || b <= 0) {
      a = rest_height(*source_.skeleton);
      b = rest_height(*target_.skeleton);
    }
    return a > 0 && b > 0 ? b / a : 1;
  }

  Path path(double scale) const {
    Path path;
    path.hips.resize(frames_);
    const Vec3 start = source_hips(0);
    for (std::size_t t = 0; t < frames_; ++t) path.hips[t] = start + scale * (source_hips(t) - start);
    path.target_ground = sole_.value_or(0);
    if (const std::vector<Feet> feet = both_feet(); !feet.empty()) {
      set_heights(feet, scale, path);
      return path;
    }
    // Without feet what is at rest shows how high a body stands.
    const double low = source_.stands->pose.positions[pairs_.source_pelvis].y;
    const double own = target_.stands->pose.positions[pairs_.target_pelvis].y;
    const bool stands = low > 0 && own > 0 && !source_.stands->frame;
    for (std::size_t t = 0; t < frames_; ++t) {
      const double height = source_hips(t).y;
      path.hips[t].y = stands ? own + scale * (height - low) : scale * height;
    }
    return path;
  }

  void place(const Path& path, Motion& motion) const {
    const Skeleton& skeleton = *target_.skeleton;
    const int pelvis = pairs_.target_pelvis;
    const auto moved = [&](std::size_t t) { return path.hips[t] - target_hips(t); };
    const auto root_to = [&](std::size_t t, Vec3 way) {
      const Vec3 place = world_.position(0)[t] + way - skeleton.above_offset;
      motion.translation(0).set(t, rotate(inverse(skeleton.above), place) / skeleton.above_scale);
    };
    if (pelvis == 0) {
      for (std::size_t t = 0; t < frames_; ++t) root_to(t, moved(t));
      return;
    }
    // The root stands to the hips, seen from above, as it does when the body stands; the pelvis moves against
    // it by what is left.
    const Pose& standing = target_.stands->pose;
    const Vec3 from_hips = standing.positions[0] - hips_at(pairs_.target, pelvis, legs_,
                                                           [&](int j) { return standing.positions[j]; });
    const int parent = skeleton.joints[pelvis].parent;
    for (std::size_t t = 0; t < frames_; ++t) {
      const Quat heading = world_.orientation(0)[t] * inverse(standing.orientations[0]);
      Vec3 root = path.hips[t] + rotate(heading, from_hips);
      root.y = standing.positions[0].y - path.target_ground + path.ground;
      const Vec3 way = root - world_.position(0)[t];
      root_to(t, way);
      const Vec3 rest = rotate(inverse(world_.orientation(parent)[t]), moved(t) - way) / skeleton.above_scale;
      motion.translation(pelvis).set(t, motion.translation(pelvis)[t] + rest);
    }
  }

 private:
  Vec3 source_hips(std::size_t t) const {
    return hips_at(pairs_.source, pairs_.source_pelvis, legs_,
                   [&](int j) { return source_.world->position(j)[t]; });
  }
  Vec3 target_hips(std::size_t t) const {
    return hips_at(pairs_.target, pairs_.target_pelvis, legs_, [&](int j) { return world_.position(j)[t]; });
  }

  std::vector<Feet> both_feet() const {
    std::vector<Feet> all;
    if (!legs_) return all;
    for (std::size_t k = 0; k < pairs_.target.legs.size(); ++k) {
      const Leg& leg = pairs_.target.legs[k];
      const std::size_t i = leg_on(pairs_.source, leg.left);
      if (i == pairs_.source.legs.size()) continue;
      const Leg& from = pairs_.source.legs[i];
      const Pose &own = target_.stands->flat[k], &theirs = source_.stands->flat[i];
      const auto ball = ball_of(leg, own, target_.skeleton->above_scale);
      const auto source_ball = ball_of(from, theirs, source_.skeleton->above_scale);
      const double ankle = own.positions[leg.ankle].y;
      Feet feet;
      feet.known = {true, ball && source_ball};
      feet.target_footing = feet.known[1] ? ball->y : ankle;
      if (feet.known[1]) {
        feet.target_stands[0] = ankle - ball->y;
        feet.source_stands[0] = theirs.positions[from.ankle].y - source_ball->y;
      }
      for (std::size_t t = 0; t < frames_; ++t) {
        const double base = target_hips(t).y;
        feet.source_height[0].push_back(source_.world->position(from.ankle)[t].y);
        feet.target_height[0].push_back(world_.position(leg.ankle)[t].y - base);
        if (!feet.known[1]) continue;
        feet.source_height[1].push_back(ball_height(from, *source_.world, t));
        feet.target_height[1].push_back(ball_height(leg, world_, t) - base);
      }
      all.push_back(std::move(feet));
    }
    return all;
  }

  void set_heights(const std::vector<Feet>& feet, double scale, Path& path) const {
    // Usual lows of heels and balls, of the lower foot: the other may not stand in this clip.
    std::array<double, 2> low{};
    std::array<bool, 2> any{};
    for (const Feet& foot : feet)
      for (std::size_t p = 0; p < 2; ++p) {
        if (!foot.known[p]) continue;
        const double own = low_of(foot.source_height[p]);
        low[p] = any[p] ? std::min(low[p], own) : own;
        any[p] = true;
      }
    const double lowest = any[1] ? std::min(low[0], low[1]) : low[0];
    const double leg = leg_length(*source_.skeleton);
    // Joints of feet are a little above the ground, which is at 0 in most studios.
    path.ground = std::fabs(lowest) < 0.1 * leg ? std::min(0.0, lowest) : lowest;
    // How high balls, or ankles, are over the ground they stand on; where the target has no mesh to tell, as
    // high as the source's.
    const auto source_footing = [&](const Feet& foot) { return low[foot.footing()] - path.ground; };
    const auto target_footing = [&](const Feet& foot) {
      return sole_ ? foot.target_footing - *sole_ : scale * source_footing(foot);
    };
    if (!sole_) path.target_ground = feet[0].target_footing - target_footing(feet[0]);
    const double near = 0.06 * leg, far_weight = 0.01;

    std::vector<double> weights(frames_), needs(frames_);
    double sum = 0, total = 0;
    for (std::size_t t = 0; t < frames_; ++t) {
      for (const Feet& foot : feet)
        for (std::size_t p = 0; p < 2; ++p) {
          if (!foot.known[p]) continue;
          const double above = std::max(0.0, foot.source_height[p][t] - low[p]);
          const double weight = exponential(-(above / near) * (above / near));
          weights[t] += weight;
          const double over = foot.source_height[p][t] - path.ground - source_footing(foot) -
                              foot.source_stands[p];  // how much higher than it stands
          needs[t] += weight * (path.ground + target_footing(foot) + foot.target_stands[p] + scale * over -
                                foot.target_height[p][t]);
        }
      sum += needs[t] - weights[t] * scale * source_hips(t).y;
      total += weights[t];
    }
    const double offset = total > 0 ? sum / total : 0;
    for (std::size_t t = 0; t < frames_; ++t)
      path.hips[t].y =
          (needs[t] + far_weight * (offset + scale * source_hips(t).y)) / (weights[t] + far_weight);
  }

  const RootSource& source_;
  const RootTarget& target_;
  const JointPairs& pairs_;
  const bool legs_;
  const std::optional<double> sole_;
  const std::size_t frames_;
  const WorldMotion world_;
};

}  // namespace

PlacedRoot place_root(const RootSource& source, const RootTarget& target, const JointPairs& pairs,
                      double asked, Motion& motion, Work& work) {
  if (motion.frames() == 0) return {asked > 0 ? asked : 1, 0};
  const Placing placing(source, target, pairs, motion, work);
  const double scale = asked > 0 ? asked : placing.own_scale();
  const Path path = placing.path(scale);
  placing.place(path, motion);
  return {scale, path.ground};
}

}  // namespace kinegraph
