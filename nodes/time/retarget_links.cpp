#include "nodes/time/retarget_links.h"

#include <algorithm>
#include <utility>

#include "nodes/motion/elementary.h"
#include "nodes/motion/joint_names.h"

namespace kinegraph {

namespace {

enum class Kind { whole, middle, limb, foot };

class Planning {
 public:
  Planning(const Skeleton& source, const Skeleton& target, const JointPairs& pairs, const StandingPose& a,
           const StandingPose& b, FeetBy feet_by)
      : source_(source), target_(target), pairs_(pairs), a_(a), b_(b), feet_by_(feet_by) {
    const double yaw = a.facing && b.facing ? *a.facing - *b.facing : 0;
    // Rest poses that face alike within a few degrees are meant to.
    const double off = turn(about_y(yaw));
    facing_ = off < 8 / degrees_per_radian && !a.frame && !b.frame ? Quat{} : about_y(yaw);
  }

  std::vector<LinkPlan> plans() {
    const auto count = static_cast<std::size_t>(target_.size());
    std::vector<LinkPlan> out(count);
    std::vector<Quat> aligned(count);  // C
    for (int j = 0; j < target_.size(); ++j) {
      LinkPlan& plan = out[j];
      plan.source = pairs_.source_of[j];
      if (plan.source < 0) continue;
      const Kind kind = kind_of(j);
      if (kind == Kind::foot) {
        plan.follow = follow_of_foot(j, plan.source);
        continue;
      }
      const int above = paired_above(j);
      if (kind == Kind::limb && above >= 0 && kind_of(above) == Kind::limb) aligned[j] = aligned[above];
      if (j == pairs_.target_pelvis) aligned[j] = fit_of(j);
      const int next = kind == Kind::whole ? -1 : next_of(j, kind);
      if (next >= 0) {
        const int source_next = pairs_.source_of[next];
        const Vec3 to = place(a_, source_next) - place(a_, plan.source);
        const Vec3 from = rotate(aligned[j] * facing_, place(b_, next) - place(b_, j));
        aligned[j] = smallest_turn(from, to) * aligned[j];
        plan.to = next;
        plan.source_to = source_next;
      }
      plan.follow = inverse(way(a_, plan.source)) * aligned[j] * facing_ * way(b_, j);
    }
    measure_shapes(out);
    return out;
  }

 private:
  static Vec3 place(const StandingPose& pose, int joint) { return pose.pose.positions[joint]; }
  static Quat way(const StandingPose& pose, int joint) { return pose.pose.orientations[joint]; }

  // How far the links that nothing turns to the source's directions are off them, as both bodies stand.
  void measure_shapes(std::vector<LinkPlan>& plans) const {
    for (int k = 0; k < target_.size(); ++k) {
      const int j = plans[k].source < 0 ? -1 : paired_above(k);
      if (j < 0 || plans[j].to == k || !source_.is_below(plans[k].source, plans[j].source)) continue;
      const Vec3 theirs = place(a_, plans[k].source) - place(a_, plans[j].source);
      const Quat turned = way(a_, plans[j].source) * plans[j].follow * inverse(way(b_, j));
      const Vec3 own = rotate(turned, place(b_, k) - place(b_, j));
      if (norm(theirs) > tiny_a_ && norm(own) > tiny_b_) {
        plans[k].shape = turn(smallest_turn(own, theirs));
        plans[k].shape_of = j;
      }
    }
  }

  // The turn that brings all links of the pelvis to within 5° of the source's directions, where there is one,
  // and so small that the pelvis stands as it did for the eye; else none.
  Quat fit_of(int j) const {
    constexpr double alike = 5 / degrees_per_radian, small = 12 / degrees_per_radian;
    std::vector<std::pair<Vec3, Vec3>> links;  // target's and source's directions
    for (int k = j + 1; k < target_.size(); ++k) {
      const int from = pairs_.source_of[k];
      if (from < 0 || paired_above(k) != j || !source_.is_below(from, pairs_.source_of[j])) continue;
      const Vec3 theirs = place(a_, from) - place(a_, pairs_.source_of[j]);
      const Vec3 own = place(b_, k) - place(b_, j);
      if (norm(theirs) > tiny_a_ && norm(own) > tiny_b_)
        links.emplace_back(normalized(rotate(facing_, own)), normalized(theirs));
    }
    const auto largest = [&](Quat by) {
      double most = 0;
      for (const auto& [own, theirs] : links)
        most = std::max(most, turn(smallest_turn(rotate(by, own), theirs)));
      return most;
    };
    if (largest({}) <= alike) return {};
    Quat fit;
    for (int round = 0; round < 100; ++round) {  // by the mean of what each of them needs
      Vec3 need;
      for (const auto& [own, theirs] : links) {
        const Quat by = smallest_turn(rotate(fit, own), theirs);
        const Vec3 axis{by.x, by.y, by.z};
        if (norm(axis) > 0) need += turn(by) / norm(axis) / static_cast<double>(links.size()) * axis;
      }
      if (norm(need) < 1e-12) break;
      fit = normalized(axis_angle(normalized(need), norm(need)) * fit);
    }
    return largest(fit) <= alike && turn(fit) <= small ? fit : Quat{};
  }

  int paired_above(int j) const {
    int above = target_.joints[j].parent;
    while (above >= 0 && pairs_.source_of[above] < 0) above = target_.joints[above].parent;
    return above;
  }

  // The leg whose foot a joint is of; -1: none.
  static int foot_of(const Skeleton& skeleton, const Body& body, int j) {
    for (std::size_t k = 0; k < body.legs.size(); ++k)
      if (skeleton.is_below(j, body.legs[k].ankle)) return static_cast<int>(k);
    return -1;
  }

  static bool is_central(const Body& body, int j) {
    return std::count(body.spine.begin(), body.spine.end(), j) > 0 ||
           std::count(body.neck.begin(), body.neck.end(), j) > 0 || j == body.head;
  }

  Kind kind_of(int j) const {
    const Body& body = pairs_.target;
    if (j == pairs_.target_pelvis) return Kind::whole;
    const int own = foot_of(target_, body, j);
    if (own >= 0 && foot_of(source_, pairs_.source, pairs_.source_of[j]) >= 0)
      return feet_by_ == FeetBy::direction &&
                     next_of(body.legs[static_cast<std::size_t>(own)].ankle, Kind::limb) >= 0
                 ? Kind::limb
                 : Kind::foot;
    if (body.head >= 0 && target_.is_below(j, body.head)) return Kind::whole;
    if (is_central(body, j)) return Kind::middle;
    for (const Leg& leg : body.legs)
      if (j != leg.hip && target_.is_below(leg.hip, j)) return Kind::middle;
    for (const Arm& arm : body.arms)
      if (j != arm.upper && target_.is_below(arm.upper, j)) return Kind::middle;
    return Kind::limb;
  }

  // The joint at the end of the link that `j` turns: the nearest paired one below on both sides; -1 where
  // that lies on it, as the link then has no direction.
  int next_of(int j, Kind kind) const {
    const int next = child_of(j, kind);
    if (next < 0) return -1;
    const double a = norm(place(a_, pairs_.source_of[next]) - place(a_, pairs_.source_of[j]));
    const double b = norm(place(b_, next) - place(b_, j));
    return a > tiny_a_ && b > tiny_b_ ? next : -1;
  }

  int child_of(int j, Kind kind) const {
    const bool central = is_central(pairs_.target, j);
    int best = -1;
    double longest = -1;
    for (int k = j + 1; k < target_.size(); ++k) {
      if (pairs_.source_of[k] < 0 || paired_above(k) != j || pairs_.source_of[k] == pairs_.source_of[j])
        continue;
      if (!source_.is_below(pairs_.source_of[k], pairs_.source_of[j])) continue;
      if (kind == Kind::middle && central && !is_central(pairs_.target, k)) continue;
      if (read_joint_name(target_.joints[k].name).word.find("thumb") != std::string::npos) continue;
      const double length = norm(place(b_, k) - place(b_, j));
      if (length <= longest) continue;
      longest = length;
      best = k;
    }
    return best;
  }

  Quat follow_of_foot(int j, int source) const {
    const auto from = static_cast<std::size_t>(foot_of(source_, pairs_.source, source));
    const auto to = static_cast<std::size_t>(foot_of(target_, pairs_.target, j));
    const Pose &a = a_.flat[from], &b = b_.flat[to];
    const auto heading = [](const Leg& leg, const Pose& pose, double scale) -> std::optional<double> {
      const auto ball = ball_of(leg, pose, scale);
      return ball ? yaw_of(*ball - pose.positions[leg.ankle]) : std::nullopt;
    };
    const auto yaw_a = heading(pairs_.source.legs[from], a, source_.above_scale);
    const auto yaw_b = heading(pairs_.target.legs[to], b, target_.above_scale);
    const Quat turned = yaw_a && yaw_b ? about_y(*yaw_a - *yaw_b) : facing_;
    return inverse(a.orientations[source]) * turned * b.orientations[j];
  }

  const Skeleton &source_, &target_;
  const JointPairs& pairs_;
  const StandingPose &a_, &b_;
  const FeetBy feet_by_;
  const double tiny_a_ = 1e-4 * rest_height(source_), tiny_b_ = 1e-4 * rest_height(target_);
  Quat facing_;
};

}  // namespace

std::vector<LinkPlan> plan_links(const Skeleton& source, const Skeleton& target, const JointPairs& pairs,
                                 const StandingPose& source_stands, const StandingPose& target_stands,
                                 FeetBy feet_by) {
  return Planning(source, target, pairs, source_stands, target_stands, feet_by).plans();
}

}  // namespace kinegraph
