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
  std::array<double, 2> standing{};  // how high they stand over the target's ground
  std::array<bool, 2> known{};
};

double low_of(std::vector<double> heights) {
  const auto tenth = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
  std::nth_element(heights.begin(), tenth, heights.end());
  return *tenth;
}

const Leg* leg_on(const Body& body, bool left) {
  for (const Leg& leg : body.legs)
    if (leg.left == left) return &leg;
  return nullptr;
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

// The lowest of a foot's joints and End Sites.
double lowest_of_foot(const Skeleton& skeleton, const Leg& leg, const Pose& pose) {
  double low = pose.positions[leg.ankle].y;
  for (int j = leg.ankle + 1; j < skeleton.size(); ++j)
    if (skeleton.is_below(j, leg.ankle)) low = std::min(low, pose.positions[j].y);
  for (const EndSite& end : skeleton.ends)
    if (skeleton.is_below(end.joint, leg.ankle))
      low = std::min(low, pose.positions[end.joint].y +
                              rotate(pose.orientations[end.joint], skeleton.above_scale * end.offset).y);
  return low;
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
    path.target_ground = target_ground();
    if (const std::vector<Feet> feet = feet_on(path.target_ground); !feet.empty()) {
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

  double target_ground() const {
    if (sole_) return *sole_;
    double low = 0;
    for (std::size_t k = 0; k < pairs_.target.legs.size(); ++k) {
      const double own = lowest_of_foot(*target_.skeleton, pairs_.target.legs[k], target_.stands->flat[k]);
      low = k == 0 ? own : std::min(low, own);
    }
    return low;
  }

  std::vector<Feet> feet_on(double ground) const {
    std::vector<Feet> all;
    if (!legs_) return all;
    for (std::size_t k = 0; k < pairs_.target.legs.size(); ++k) {
      const Leg& leg = pairs_.target.legs[k];
      const Leg* from = leg_on(pairs_.source, leg.left);
      if (!from) continue;
      const Pose& flat = target_.stands->flat[k];
      // In a frame of a motion each foot has its own ground.
      const double own = target_.stands->frame ? lowest_of_foot(*target_.skeleton, leg, flat) : ground;
      const auto ball = ball_of(leg, flat, target_.skeleton->above_scale);
      Feet feet;
      feet.known = {true, ball && (from->toe >= 0 || from->toe_tip)};
      feet.standing = {flat.positions[leg.ankle].y - own, ball ? ball->y - own : 0};
      for (std::size_t t = 0; t < frames_; ++t) {
        const double base = target_hips(t).y;
        feet.source_height[0].push_back(source_.world->position(from->ankle)[t].y);
        feet.target_height[0].push_back(world_.position(leg.ankle)[t].y - base);
        if (!feet.known[1]) continue;
        feet.source_height[1].push_back(ball_height(*from, *source_.world, t));
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
    const double under = sole_ ? 0 : scale * (lowest - path.ground);  // the joints' height over a sole unseen
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
          needs[t] +=
              weight * (path.ground + under + foot.standing[p] + scale * above - foot.target_height[p][t]);
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

double place_root(const RootSource& source, const RootTarget& target, const JointPairs& pairs, double asked,
                  Motion& motion, Work& work) {
  if (motion.frames() == 0) return asked > 0 ? asked : 1;
  const Placing placing(source, target, pairs, motion, work);
  const double scale = asked > 0 ? asked : placing.own_scale();
  placing.place(placing.path(scale), motion);
  return scale;
}

}  // namespace kinegraph
