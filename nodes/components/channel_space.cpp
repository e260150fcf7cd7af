#include <algorithm>
#include <optional>

#include "nodes/components/channels.h"
#include "nodes/components/decomposed_pose.h"
#include "nodes/components/stabilised_points.h"
#include "nodes/motion/quaternion_mean.h"

namespace kinegraph {
namespace {

std::string euler_order(const Motion& motion, int joint) {
  std::string order;
  const auto& layout = motion.source().bvh;
  if (joint < static_cast<int>(layout.size()))
    for (const std::string& channel : layout[joint].channels)
      if (channel.size() > 1 && channel.find("rotation") != std::string::npos) order += channel[0];
  return order.size() == 3 ? order : "ZYX";
}

}  // namespace

const char* name_of(Representation representation) {
  switch (representation) {
    case Representation::points:
      return "points";
    case Representation::quaternions:
      return "quaternions";
    case Representation::euler:
      return "euler";
    case Representation::logarithm:
      return "logarithm";
  }
  return "";
}

Representation representation_from(const std::string& name) {
  for (Representation r : {Representation::points, Representation::quaternions, Representation::euler})
    if (name == name_of(r)) return r;
  return Representation::logarithm;
}

std::vector<std::string> ChannelSpace::channel_names() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t c = 0; c < per_label(); ++c)
      names.push_back(
          labels[i] + "." +
          (representation == Representation::euler ? orders[i].substr(c, 1) : std::string(1, "xyzw"[c])));
  return names;
}

namespace {

// Of each joint of `wanted` the joint of that name, where all are there.
std::optional<std::vector<int>> same_names(const Skeleton& wanted, const Skeleton& skeleton) {
  std::vector<int> out;
  for (const Joint& joint : wanted.joints) {
    out.push_back(skeleton.find(joint.name));
    if (out.back() < 0) return std::nullopt;
  }
  return out;
}

// A map that no clip needs: an error where it names joints that aren't there, else told.
void check_map(const ChannelSpace& space, const std::vector<std::shared_ptr<const Motion>>& motions,
               Work& work) {
  for (const auto& motion : motions)
    if (!same_names(*space.skeleton, motion->skeleton())) return;
  if (space.map.empty()) return;
  partners(motions.back()->skeleton(), *space.skeleton, space.map);
  work.report(warning("map-unused", "every clip has the first one's joints by name: `map` says nothing")
                  .at_param("map")
                  .hinting("leave `map` empty, or rename joints in the files"));
}

}  // namespace

std::vector<int> joints_of(const ChannelSpace& space, const Skeleton& skeleton) {
  if (auto all = same_names(*space.skeleton, skeleton)) return *all;
  return partners(skeleton, *space.skeleton, space.map);
}

ChannelSpace space_of_motions(Representation representation,
                              const std::vector<std::shared_ptr<const Motion>>& motions,
                              const std::vector<bool>& chosen, bool heading,
                              const std::vector<std::string>& map, Work& work) {
  ChannelSpace space;
  space.representation = representation;
  space.heading = heading;
  space.skeleton = motions.front()->shared_skeleton();
  space.map = map;
  check_map(space, motions, work);
  std::vector<std::vector<int>> joints;
  for (const auto& motion : motions) joints.push_back(joints_of(space, motion->skeleton()));
  for (int j = 0; j < space.skeleton->size(); ++j) {
    if (!chosen[j]) continue;
    const std::string& name = space.skeleton->joints[j].name;
    for (std::size_t m = 0; m < motions.size(); ++m)
      if (joints[m][j] < 0)
        throw Failure(
            error("joint-missing", "clip " + std::to_string(m) + " has no joint '" + name + "'")
                .at_port("motions")
                .at_joint(name)
                .hinting("leave it out with `joints`, name its partner in `map`, or bring the motions to one "
                         "skeleton with Retarget"));
    space.joints.push_back(j);
    space.labels.push_back(name);
    space.orders.push_back(euler_order(*motions.front(), j));
  }
  if (space.joints.empty())
    throw Failure(
        error("no-joints", "no joint is chosen").at_param("joints").hinting("choose some, or `*` for all"));
  if (representation == Representation::quaternions || representation == Representation::logarithm) {
    std::vector<DecomposedPose> prepared;
    for (const auto& motion : motions) prepared.emplace_back(space, *motion, work);
    for (int joint : space.joints) {
      std::vector<double> x, y, z, w;
      for (const DecomposedPose& one : prepared) {
        for (std::size_t t = 0; t < one.motion().frames(); ++t) {
          const Quat q = one.local(joint, t);
          x.push_back(q.x);
          y.push_back(q.y);
          z.push_back(q.z);
          w.push_back(q.w);
        }
      }
      space.reference.push_back(karcher_mean(ConstQuatTrack{x, y, z, w}).mean);
      work.check();
    }
  }
  return space;
}

ChannelSpace space_of_points(const std::vector<std::shared_ptr<const Points>>& points, Stabilise stabilise,
                             const std::vector<bool>& chosen) {
  const Points& first = *points.front();
  ChannelSpace space;
  space.of_motions = false;
  space.heading = false;
  space.stabilise = stabilise;
  for (std::size_t i = 0; i < first.labels.size(); ++i) {
    if (stabilise != Stabilise::none || chosen[i]) space.labels.push_back(first.labels[i]);
    if (stabilise != Stabilise::none && chosen[i]) space.stable.push_back(first.labels[i]);
  }
  if (space.labels.empty() || (stabilise == Stabilise::centroid && space.stable.empty()) ||
      (stabilise == Stabilise::rigid && space.stable.size() < 3))
    throw Failure(
        error("too-few-labels", "too few points are chosen")
            .at_param("joints")
            .hinting(stabilise == Stabilise::rigid ? "a rigid motion takes three or more" : "choose some"));
  for (std::size_t p = 0; p < points.size(); ++p) {
    const std::string clip = points.size() > 1 ? "clip " + std::to_string(p) : "the clip";
    check_whole(*points[p], labels_of(space.labels, *points[p], clip), clip);
  }
  if (stabilise == Stabilise::rigid && first.frames > 0) {
    Vec3 centre;
    const auto stable = labels_of(space.stable, first);
    for (int label : stable) centre += first.track(label)[0];
    centre = centre / static_cast<double>(stable.size());
    for (int label : stable) space.shape.push_back(first.track(label)[0] - centre);
  }
  return space;
}

}  // namespace kinegraph
