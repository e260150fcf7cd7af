#include "nodes/cartoon/rubber_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "nodes/cartoon/link_turns.h"
#include "nodes/cartoon/planted_limbs.h"
#include "nodes/cartoon/world_to_local.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {
namespace {

// Sub-joints on curves and straight links.
WorldMotion driven_positions(const SubJoints& sub, const WorldMotion& world, Work& work) {
  WorldMotion out(static_cast<int>(sub.all.size()), world.frames(), world.scale());
  for (int i = 0; i < out.joints(); ++i) {
    work.check();
    const auto at = out.position(i);
    for (const auto& [joint, weight] : sub.weights[i]) {
      const auto from = world.position(joint);
      for (std::size_t t = 0; t < world.frames(); ++t) at.x[t] += weight * from.x[t];
      for (std::size_t t = 0; t < world.frames(); ++t) at.y[t] += weight * from.y[t];
      for (std::size_t t = 0; t < world.frames(); ++t) at.z[t] += weight * from.z[t];
    }
  }
  return out;
}

void swing(const Motion& motion, const SubJoints& sub, const RubberParams& params, const Contacts* contacts,
           WorldMotion& places, Work& work) {
  const std::size_t count = sub.all.size();
  std::vector<int> parents;
  for (const SubJoint& one : sub.all) parents.push_back(one.parent);
  ParticlePath driven{count, std::vector<Vec3>(count * places.frames())};
  for (std::size_t i = 0; i < count; ++i) {
    const auto from = std::as_const(places).position(static_cast<int>(i));
    for (std::size_t t = 0; t < places.frames(); ++t) driven.at[t * count + i] = from[t];
  }
  const ParticlePath masses = simulate(parents, driven, motion.fps(), params.springs, false, work).positions;
  std::vector<std::vector<double>> left(count);
  if (contacts) left = swing_left(motion, sub, *contacts);
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = places.position(static_cast<int>(i));
    for (std::size_t t = 0; t < places.frames(); ++t) {
      const Vec3 s = at[t];
      const double part = params.blend * (left[i].empty() ? 1 : left[i][t]);
      at.set(t, s + part * (masses.at[t * count + i] - s));
    }
  }
}

// Orientations of the sub-joints; `ends`: links_below() of the joints.
class Turning {
 public:
  Turning(const Skeleton& skeleton, const SubJoints& sub, const std::vector<std::vector<int>>& ends,
          const WorldMotion& world, double most_twist, WorldMotion& places)
      : skeleton_(skeleton),
        sub_(sub),
        ends_(ends),
        world_(world),
        most_twist_(most_twist),
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
    aim_link(world_.position(from_joint), world_.position(to_joint), place(from_sub), place(to_sub),
             world_.orientation(k), most_twist_, places_.orientation(sub_.first[k]));
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
      std::vector<Vec3> a(below.size()), b(below.size());
      const auto out = places_.orientation(own);
      for (std::size_t t = 0; t < world_.frames(); ++t) {
        for (std::size_t i = 0; i < below.size(); ++i) {
          a[i] = world_.position(below[i])[t] - world_.position(k)[t];
          b[i] = place(sub_.first[below[i]])[t] - place(own)[t];
        }
        out.set(t, normalized(best_turn(a, b) * world_.orientation(k)[t]));
      }
      limit_turns(world_.orientation(k), most_twist_, out);
    }
  }

  // Slerp from J′_{k,1} to the child's first. The turn between them is followed through time, so that it may
  // pass half a turn without the way round changing.
  void turn_rest(int k) {
    const int own = sub_.first[k];
    const SubJoint& first = sub_.all[own];
    const auto from = std::as_const(places_).orientation(own);
    const auto to = std::as_const(places_).orientation(sub_.first[first.next]);
    Quat before{};
    for (std::size_t t = 0; t < world_.frames(); ++t) {
      const Quat between = nearer(inverse(from[t]) * to[t], before);
      before = between;
      const Vec3 half = log(between);
      for (int l = 1; l < first.count; ++l)
        places_.orientation(own + l).set(t, normalized(from[t] * exp(sub_.all[own + l].part() * half)));
    }
  }

  const Skeleton& skeleton_;
  const SubJoints& sub_;
  const std::vector<std::vector<int>>& ends_;
  const WorldMotion& world_;
  double most_twist_;
  WorldMotion& places_;
};

std::shared_ptr<const Skeleton> skeleton_at(const Skeleton& skeleton, const SubJoints& sub,
                                            const WorldMotion& rest) {
  auto out = std::make_shared<Skeleton>();
  out->above = skeleton.above;
  out->above_offset = skeleton.above_offset;
  out->above_scale = skeleton.above_scale;
  std::set<std::string> taken;
  for (const Joint& joint : skeleton.joints) taken.insert(joint.name);
  for (std::size_t i = 0; i < sub.all.size(); ++i) {
    const SubJoint& one = sub.all[i];
    Joint joint;
    joint.name = skeleton.joints[one.joint].name;
    if (one.step > 0) {
      joint.name += fmt::format("_{}", one.step + 1);
      while (!taken.insert(joint.name).second) joint.name += "_";
    }
    joint.parent = one.parent;
    if (one.parent < 0) {
      joint.offset = skeleton.joints[one.joint].offset;
      joint.rest = normalized(inverse(skeleton.above) * rest.orientation(static_cast<int>(i))[0]);
    } else {
      const Quat above = rest.orientation(one.parent)[0];
      const Vec3 from = rest.position(one.parent)[0];
      joint.offset =
          rotate(inverse(above), rest.position(static_cast<int>(i))[0] - from) / skeleton.above_scale;
      joint.rest = normalized(inverse(above) * rest.orientation(static_cast<int>(i))[0]);
      joint.rest = nearer(joint.rest, Quat{});
    }
    out->joints.push_back(std::move(joint));
  }
  for (EndSite end : skeleton.ends) {
    end.joint = sub.first[end.joint];
    out->ends.push_back(std::move(end));
  }
  return out;
}

// The unit, the axes and the frame time; the layout of a BVH's joints is the old skeleton's.
std::shared_ptr<const SourceFacts> facts_without_layout(const SourceFacts& source) {
  auto facts = std::make_shared<SourceFacts>(source);
  facts->bvh.clear();
  facts->bvh_ends.clear();
  facts->read.reset();
  facts->read_frames = facts->first_read = 0;
  return facts;
}

}  // namespace

SubSkeleton sub_skeleton(const Motion& motion, const SubJoints& sub, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  const Motion at_rest(motion.shared_skeleton(), motion.shared_source(), motion.fps(), 1,
                       std::vector<bool>(skeleton.joints.size(), false));
  const WorldMotion world = world_motion(at_rest, work);
  WorldMotion places = driven_positions(sub, world, work);
  Turning(skeleton, sub, links_below(motion), world, most_twist_at(motion.fps()), places).turn_all(work);
  SubSkeleton out;
  out.skeleton = skeleton_at(skeleton, sub, places);
  for (int i = 0; i < places.joints(); ++i) {
    out.rest.positions.push_back(std::as_const(places).position(i)[0]);
    out.rest.orientations.push_back(std::as_const(places).orientation(i)[0]);
  }
  return out;
}

RubberResult rubber_joints(const Motion& motion, const RubberParams& params, const Contacts* contacts,
                           Work& work) {
  RubberResult result;
  const Skeleton& skeleton = motion.skeleton();
  if (skeleton.size() == 0) {
    result.motion = motion;
    return result;
  }
  result.sub_joints = lay_sub_joints(motion, params.sub_joints, work);
  const SubJoints& sub = result.sub_joints;
  const std::vector<std::vector<int>> ends = links_below(motion);
  const double most_twist = most_twist_at(motion.fps());

  const std::shared_ptr<const Skeleton> rubber = sub_skeleton(motion, sub, work).skeleton;

  const WorldMotion world = world_motion(motion, work);
  WorldMotion places = driven_positions(sub, world, work);
  work.progress(0.2);
  if (params.simulate && params.blend != 0 && motion.frames() > 1)
    swing(motion, sub, params, contacts, places, work);
  work.progress(0.7);
  Turning(skeleton, sub, ends, world, most_twist, places).turn_all(work);
  std::vector<bool> translates(rubber->joints.size());
  translates[0] = motion.translates(0);
  result.motion = motion_from_world(rubber, facts_without_layout(motion.source()), motion.fps(), translates,
                                    places, work);
  return result;
}

}  // namespace kinegraph
