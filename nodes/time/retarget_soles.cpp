#include "nodes/time/retarget_soles.h"

#include <algorithm>
#include <limits>
#include <map>

#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// Down, and leaning from it to all sides.
std::vector<Vec3> directions() {
  constexpr int around = 12;
  std::vector<Vec3> all = {{0, -1, 0}};
  for (const double lean : {20.0, 40.0, 60.0, 80.0})
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around, out = sine(lean / degrees_per_radian);
      all.push_back({out * cosine(angle), -cosine(lean / degrees_per_radian), out * sine(angle)});
    }
  return all;
}

// The joint that a vertex follows most.
int joint_of(const MeshPart& part, const Skin& skin, std::size_t vertex) {
  const std::size_t first = vertex * static_cast<std::size_t>(part.influences);
  std::size_t best = first;
  for (std::size_t k = first; k < first + static_cast<std::size_t>(part.influences); ++k)
    if (part.weights[k] > part.weights[best]) best = k;
  return skin.joints[part.joints[best]];
}

// Turns about a place, one after the other.
struct Turned {
  Quat by;
  Vec3 about;
  Vec3 operator()(Vec3 p) const { return about + rotate(by, p - about); }
};

// The least part of `whole` that lifts all points to the ground; all of it where none does.
Turned lifted(Quat whole, Vec3 about, const std::vector<Vec3>& points, double ground) {
  const auto below = [&](Quat by) {
    return std::any_of(points.begin(), points.end(),
                       [&](Vec3 p) { return about.y + rotate(by, p - about).y < ground; });
  };
  if (!below({})) return {{}, about};
  if (below(whole)) return {whole, about};
  double low = 0, high = 1;
  for (int step = 0; step < 24; ++step) {
    const double middle = 0.5 * (low + high);
    (below(slerp(middle, Quat{}, whole)) ? low : high) = middle;
  }
  return {slerp(high, Quat{}, whole), about};
}

// What turns a joint, as it is, to lie as flat as in a pose.
Quat to_flat(const Pose& flat, int joint, Quat now) {
  const Vec3 up{0, 1, 0};
  const Vec3 own = rotate(inverse(flat.orientations[static_cast<std::size_t>(joint)]), up);
  return smallest_turn(rotate(now, own), up);
}

}  // namespace

std::vector<SolePoint> sole_points(const Character& character) {
  const Skeleton& skeleton = *character.skeleton;
  const Pose rest = rest_pose_of(skeleton);
  const std::vector<Vec3> ways = directions();
  struct Outermost {
    double reach = -std::numeric_limits<double>::infinity();
    Vec3 at;
  };
  std::map<int, std::vector<Outermost>> of_joint;
  for (const Leg& leg : find_legs(skeleton))
    for (const MeshPart& part : character.parts) {
      if (part.skin < 0) continue;
      const std::vector<Vec3> vertices = posed_vertices(character, part, rest);
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        const int joint = joint_of(part, character.skins[static_cast<std::size_t>(part.skin)], v);
        if (!skeleton.is_below(joint, leg.ankle)) continue;
        auto& outermost = of_joint.try_emplace(joint, ways.size()).first->second;
        for (std::size_t w = 0; w < ways.size(); ++w)
          if (const double reach = dot(ways[w], vertices[v]); reach > outermost[w].reach)
            outermost[w] = {reach, vertices[v]};
      }
    }
  std::vector<SolePoint> points;
  for (const auto& [joint, outermost] : of_joint)
    for (std::size_t w = 0; w < outermost.size(); ++w) {
      const auto same = [&](const Outermost& one) { return one.at == outermost[w].at; };
      if (std::any_of(outermost.begin(), outermost.begin() + static_cast<std::ptrdiff_t>(w), same)) continue;
      const auto j = static_cast<std::size_t>(joint);
      points.push_back({joint, rotate(inverse(rest.orientations[j]), outermost[w].at - rest.positions[j]) /
                                   skeleton.above_scale});
    }
  return points;
}

void keep_soles_up(const std::vector<Leg>& legs, const StandingPose& stands,
                   const std::vector<SolePoint>& points, double ground, Motion& motion, Work& work) {
  if (points.empty() || motion.frames() == 0) return;
  const Skeleton& skeleton = motion.skeleton();
  const WorldMotion world = world_motion(motion, work);
  const auto above = [&](int joint, std::size_t t) -> Quat {
    const int parent = skeleton.joints[joint].parent;
    return parent < 0 ? skeleton.above : Quat(world.orientation(parent)[t]);
  };
  for (std::size_t k = 0; k < legs.size(); ++k) {
    const Leg& leg = legs[k];
    std::vector<SolePoint> of_foot, of_toes;
    for (const SolePoint& point : points)
      if (leg.toe >= 0 && skeleton.is_below(point.joint, leg.toe))
        of_toes.push_back(point);
      else if (skeleton.is_below(point.joint, leg.ankle))
        of_foot.push_back(point);
    std::vector<Vec3> foot(of_foot.size()), toes(of_toes.size());
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      if (t % 64 == 0) work.check();
      for (std::size_t i = 0; i < foot.size(); ++i)
        foot[i] = point_at(world, of_foot[i].joint, of_foot[i].at, t);
      const Quat ankle = world.orientation(leg.ankle)[t];
      const Turned up =
          lifted(to_flat(stands.flat[k], leg.ankle, ankle), world.position(leg.ankle)[t], foot, ground);
      motion.rotation(leg.ankle).set(t, normalized(inverse(above(leg.ankle, t)) * up.by * ankle));
      if (toes.empty()) continue;
      for (std::size_t i = 0; i < toes.size(); ++i)
        toes[i] = up(point_at(world, of_toes[i].joint, of_toes[i].at, t));
      const Quat toe = up.by * world.orientation(leg.toe)[t];
      const Turned bent =
          lifted(to_flat(stands.flat[k], leg.toe, toe), up(world.position(leg.toe)[t]), toes, ground);
      motion.rotation(leg.toe).set(t, normalized(inverse(up.by * above(leg.toe, t)) * bent.by * toe));
    }
  }
}

}  // namespace kinegraph
