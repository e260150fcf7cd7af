#include "nodes/cartoon/rubber_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "nodes/cartoon/contact_joints.h"
#include "nodes/cartoon/limb_swings.h"
#include "nodes/cartoon/link_turns.h"
#include "nodes/cartoon/planted_limbs.h"
#include "nodes/cartoon/sub_joint_flips.h"
#include "nodes/cartoon/sub_joint_turns.h"
#include "nodes/cartoon/world_to_local.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {
namespace {

// A curve through joints whose links are of very different lengths swings far away from them where they turn:
// a fold in the middle of two equal links goes an eighth of the group's length away, and up to `bulge`
// nothing changes; beyond it sub-joints come smoothly nearer to their straight links, so that none is further
// off than `most_bulge`.
constexpr double bulge = 0.15, most_bulge = 0.25;  // of the group's present length

void hold_to_links(const SubJoints& sub, const WorldMotion& world, WorldMotion& places, Work& work) {
  std::vector<double> length(world.frames());
  for (const auto& group : sub.groups) {
    work.check();
    std::fill(length.begin(), length.end(), 0.0);
    for (std::size_t n = 0; n + 1 < group.size(); ++n) {
      const auto a = world.position(group[n]), b = world.position(group[n + 1]);
      for (std::size_t t = 0; t < length.size(); ++t) length[t] += norm(b[t] - a[t]);
    }
    for (std::size_t n = 0; n + 1 < group.size(); ++n) {
      const auto a = world.position(group[n]), b = world.position(group[n + 1]);
      for (int l = 1; l < sub.all[sub.first[group[n]]].count; ++l) {
        const double part = sub.all[sub.first[group[n]] + l].part();
        const auto at = places.position(sub.first[group[n]] + l);
        for (std::size_t t = 0; t < length.size(); ++t) {
          const Vec3 straight = a[t] + part * (b[t] - a[t]), away = at[t] - straight;
          const double free = bulge * length[t], square = dot(away, away);
          if (!(square > free * free)) continue;
          const double far = std::sqrt(square), over = far - free, room = (most_bulge - bulge) * length[t];
          at.set(t, straight + ((free + over * room / (room + over)) / far) * away);
        }
      }
    }
  }
}

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
  hold_to_links(sub, world, out, work);
  return out;
}

// How far the springs take sub-joints from their driven places, times `blend`.
std::vector<Vec3> swings(const Motion& motion, const SubJoints& sub, const RubberParams& params,
                         const WorldMotion& places, Work& work) {
  const std::size_t count = sub.all.size();
  std::vector<int> parents;
  for (const SubJoint& one : sub.all) parents.push_back(one.parent);
  ParticlePath driven{count, std::vector<Vec3>(count * places.frames())};
  // A few frames at once, so that what is written stays in the cache.
  constexpr std::size_t at_once = 16;
  for (std::size_t start = 0; start < places.frames(); start += at_once) {
    const std::size_t end = std::min(start + at_once, places.frames());
    for (std::size_t i = 0; i < count; ++i) {
      const auto from = places.position(static_cast<int>(i));
      for (std::size_t t = start; t < end; ++t) driven.at[t * count + i] = from[t];
    }
  }
  ParticlePath masses = simulate(parents, driven, motion.fps(), params.springs, false, work).positions;
  for (std::size_t n = 0; n < masses.at.size(); ++n)
    masses.at[n] = params.blend * (masses.at[n] - driven.at[n]);
  return std::move(masses.at);
}

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

// Each joint's link to its first child at rest, in its own frame; zero for a tip.
std::vector<Vec3> own_links(const Skeleton& skeleton) {
  std::vector<Vec3> links(skeleton.joints.size());
  for (int j = skeleton.size() - 1; j > 0; --j)
    links[skeleton.joints[j].parent] = normalized(skeleton.joints[j].offset);
  return links;
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
  turn_sub_joints(skeleton, sub, links_below(motion), world, motion.fps(), {}, places, work);
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
  const std::vector<int> planted = contacts ? contact_joints(*contacts, motion, work) : std::vector<int>();
  result.sub_joints = lay_sub_joints(motion, params.sub_joints, work);
  const SubJoints& sub = result.sub_joints;
  const std::shared_ptr<const Skeleton> rubber = sub_skeleton(motion, sub, work).skeleton;

  const WorldMotion world = world_motion(motion, work);
  WorldMotion places = driven_positions(sub, world, work);
  const FlipWatch watch(sub, *rubber, world, motion.fps());
  straighten_flips(sub, watch, world, motion.fps(), places, work);
  work.progress(0.2);
  if (params.simulate && params.blend != 0 && motion.frames() > 1) {
    const auto left = contacts ? swing_left(motion, sub, *contacts, planted)
                               : std::vector<std::vector<double>>(sub.all.size());
    add_swings(sub, watch, swings(motion, sub, params, places, work), left, motion.fps(), places, work);
  }
  work.progress(0.7);
  turn_sub_joints(skeleton, sub, links_below(motion), world, motion.fps(), own_links(*rubber), places, work);
  std::vector<bool> translates(rubber->joints.size());
  translates[0] = motion.translates(0);
  result.motion = motion_from_world(rubber, facts_without_layout(motion.source()), motion.fps(), translates,
                                    places, work);
  return result;
}

}  // namespace kinegraph
