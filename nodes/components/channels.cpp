#include "nodes/components/channels.h"

#include <cmath>

#include "nodes/components/points_to_rotations.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/style/quaternion_mean.h"

namespace kinegraph {
namespace {

// A motion's rotations in the frame that is decomposed: local ones, the root's with R_y(-ψ) taken out (ρ, in world) or in
// world as it stands.
class Prepared {
 public:
  Prepared(const ChannelSpace& space, const Motion& motion, Work& work)
      : motion_(motion), heading_(space.heading), root_(encode_root(motion, work)) {
    for (const Joint& joint : space.skeleton->joints) {
      const int at = motion.skeleton().find(joint.name);
      joint_of_.push_back(at);
    }
  }
  // `joint` of the space's skeleton; identity rest where the motion lacks it.
  Quat local(int joint, std::size_t t) const {
    const int at = joint_of_[joint];
    if (at < 0) return {};
    if (at > 0) return motion_.rotation(at)[t];
    return heading_ ? root_.rho[t] : about_y(root_.heading[t]) * root_.rho[t];
  }
  int joint(int of_space) const { return joint_of_[of_space]; }
  const EncodedRoot& root() const { return root_; }
  const Motion& motion() const { return motion_; }
  bool heading() const { return heading_; }

 private:
  const Motion& motion_;
  bool heading_;
  EncodedRoot root_;
  std::vector<int> joint_of_;
};

Vec3 link_of(const ChannelSpace& space, const Prepared& prepared, int joint, std::size_t t) {
  const int at = prepared.joint(joint);
  if (at > 0 && prepared.motion().translates(at)) return prepared.motion().local_offset(at, t);
  return space.skeleton->joints[joint].offset;
}

// Positions of all joints with the root at the origin, and world orientations, in the frame that is decomposed.
struct RootedPose {
  std::vector<Vec3> positions;
  std::vector<Quat> world, local;
};
void rooted_pose(const ChannelSpace& space, const Prepared& prepared, std::size_t t, RootedPose& pose) {
  const int n = space.skeleton->size();
  pose.positions.resize(n);
  pose.world.resize(n);
  pose.local.resize(n);
  for (int j = 0; j < n; ++j) {
    pose.local[j] = prepared.local(j, t);
    const int parent = space.skeleton->joints[j].parent;
    if (parent < 0) {
      pose.positions[j] = {};
      pose.world[j] = pose.local[j];
    } else {
      pose.positions[j] = pose.positions[parent] + rotate(pose.world[parent], link_of(space, prepared, j, t));
      pose.world[j] = pose.world[parent] * pose.local[j];
    }
  }
}

std::vector<bool> flags_of(const ChannelSpace& space) {
  std::vector<bool> flags(space.skeleton->joints.size(), false);
  for (int joint : space.joints) flags[joint] = true;
  return flags;
}

// Angles in steps of less than half a turn from one to the next.
double unwrapped(double angle, double before) {
  return angle - 2 * pi * std::round((angle - before) / (2 * pi));
}

std::string euler_order(const Motion& motion, int joint) {
  std::string order;
  const auto& layout = motion.source().bvh;
  if (joint < static_cast<int>(layout.size()))
    for (const std::string& channel : layout[joint].channels)
      if (channel.size() > 1 && channel.find("rotation") != std::string::npos) order += channel[0];
  return order.size() == 3 ? order : "ZYX";
}

void put(Rows& rows, std::size_t row, std::size_t t, Vec3 v) {
  rows(row, t) = v.x;
  rows(row + 1, t) = v.y;
  rows(row + 2, t) = v.z;
}
Vec3 vector_at(const Rows& rows, std::size_t row, std::size_t t) {
  return {rows(row, t), rows(row + 1, t), rows(row + 2, t)};
}

// The rotation that one entry's numbers mean.
Quat rotation_at(const ChannelSpace& space, std::size_t entry, const Rows& channels, std::size_t t) {
  const std::size_t row = entry * space.per_label();
  switch (space.representation) {
    case Representation::quaternions:
      return normalized(Quat{channels(row, t), channels(row + 1, t), channels(row + 2, t), channels(row + 3, t)});
    case Representation::euler: {
      const double angles[3] = {channels(row, t), channels(row + 1, t), channels(row + 2, t)};
      return from_euler(space.orders[entry], angles);
    }
    case Representation::logarithm:
      return space.reference[entry] * exp(0.5 * vector_at(channels, row, t));
    case Representation::points:
      break;
  }
  return {};
}

// The base with other rotations (in the frame that is decomposed) and, where given, other local translations.
class Rebuilt {
 public:
  Rebuilt(const ChannelSpace& space, const Prepared& base) : space_(space), base_(base), motion_(base.motion()) {}

  void give_translations(const std::vector<bool>& joints) {
    for (int j = 1; j < space_.skeleton->size(); ++j) {
      const int at = base_.joint(j);
      if (joints[j] && at > 0 && !motion_.translates(at)) motion_ = motion_.with_translation(at);
    }
  }
  void set_local(int joint, std::size_t t, Quat q) {
    const int at = base_.joint(joint);
    if (at < 0) return;
    if (at > 0)
      motion_.rotation(at).set(t, q);
    else
      root_.push_back(base_.heading() ? q : about_y(-base_.root().heading[t]) * q);
  }
  void set_translation(int joint, std::size_t t, Vec3 offset) {
    const int at = base_.joint(joint);
    if (at > 0 && motion_.translates(at)) motion_.translation(at).set(t, offset);
  }
  Motion finish() {
    EncodedRoot root = base_.root();
    if (root_.size() == root.rho.size()) root.rho = root_;
    decode_root_keeping_heading(root, motion_);
    // decode_root integrates the path; the base's own numbers are exact.
    if (base_.motion().translates(0)) {
      auto from = base_.motion().translation(0);
      auto to = motion_.translation(0);
      for (std::size_t t = 0; t < motion_.frames(); ++t) to.set(t, from[t]);
    }
    for (int j = 0; j < motion_.joints(); ++j) {
      auto track = motion_.rotation(j);
      make_continuous(track.x, track.y, track.z, track.w);
    }
    return std::move(motion_);
  }

 private:
  const ChannelSpace& space_;
  const Prepared& base_;
  Motion motion_;
  std::vector<Quat> root_;  // ρ of the frames set so far, in order
};

}  // namespace

const char* name_of(Representation representation) {
  switch (representation) {
    case Representation::points: return "points";
    case Representation::quaternions: return "quaternions";
    case Representation::euler: return "euler";
    case Representation::logarithm: return "logarithm";
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
      names.push_back(labels[i] + "." +
                      (representation == Representation::euler ? orders[i].substr(c, 1) : std::string(1, "xyzw"[c])));
  return names;
}

ChannelSpace space_of_motions(Representation representation, const std::vector<std::shared_ptr<const Motion>>& motions,
                              const std::vector<bool>& chosen, bool heading, Work& work) {
  ChannelSpace space;
  space.representation = representation;
  space.heading = heading;
  space.skeleton = motions.front()->shared_skeleton();
  for (int j = 0; j < space.skeleton->size(); ++j) {
    if (!chosen[j]) continue;
    const std::string& name = space.skeleton->joints[j].name;
    for (std::size_t m = 0; m < motions.size(); ++m)
      if (motions[m]->skeleton().find(name) < 0)
        throw Failure(error("joint-missing", "input " + std::to_string(m) + " has no joint '" + name + "'")
                          .at_port("motions")
                          .at_joint(name)
                          .hinting("leave it out with `joints`, or bring the motions to one skeleton with Retarget"));
    space.joints.push_back(j);
    space.labels.push_back(name);
    space.orders.push_back(euler_order(*motions.front(), j));
  }
  if (representation == Representation::quaternions || representation == Representation::logarithm) {
    std::vector<Prepared> prepared;
    for (const auto& motion : motions) prepared.emplace_back(space, *motion, work);
    for (int joint : space.joints) {
      std::vector<double> x, y, z, w;
      for (const Prepared& one : prepared) {
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

ChannelSpace space_of_points(const std::vector<std::shared_ptr<const Points>>& points) {
  ChannelSpace space;
  space.of_motions = false;
  space.heading = false;
  space.labels = points.front()->labels;
  return space;
}

Rows channels_of(const ChannelSpace& space, const Motion& motion, const std::vector<double>& before, Work& work) {
  const Prepared prepared(space, motion, work);
  const std::size_t frames = motion.frames(), per = space.per_label();
  Rows out(space.channels(), frames);
  if (space.representation == Representation::points) {
    RootedPose pose;
    for (std::size_t t = 0; t < frames; ++t) {
      if (t % 256 == 0) work.check();
      rooted_pose(space, prepared, t, pose);
      for (std::size_t i = 0; i < space.joints.size(); ++i) put(out, i * per, t, pose.positions[space.joints[i]]);
    }
    return out;
  }
  for (std::size_t i = 0; i < space.joints.size(); ++i) {
    work.check();
    const std::size_t row = i * per;
    for (std::size_t t = 0; t < frames; ++t) {
      const Quat q = prepared.local(space.joints[i], t);
      if (space.representation == Representation::quaternions) {
        const Quat turned = nearer(q, space.reference[i]);
        put(out, row, t, {turned.x, turned.y, turned.z});
        out(row + 3, t) = turned.w;
      } else if (space.representation == Representation::logarithm) {
        put(out, row, t, 2 * log(nearer(inverse(space.reference[i]) * q, Quat{})));
      } else {
        double near[3] = {};
        for (std::size_t c = 0; c < 3; ++c)
          near[c] = t > 0 ? out(row + c, t - 1) : before.empty() ? 0 : before[row + c];
        auto angles = to_euler(q, space.orders[i], near);
        for (std::size_t c = 0; c < 3; ++c) out(row + c, t) = unwrapped(angles[c], near[c]);
      }
    }
  }
  return out;
}

Rows channels_of(const ChannelSpace& space, const Points& points, Work& work) {
  Rows out(space.channels(), points.frames);
  for (std::size_t i = 0; i < space.labels.size(); ++i) {
    work.check();
    const auto track = points.track(static_cast<int>(i));
    for (std::size_t t = 0; t < points.frames; ++t) put(out, 3 * i, t, track[t]);
  }
  return out;
}

Motion motion_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base, bool limbs,
                            Work& work) {
  const Prepared prepared(space, base, work);
  Rebuilt rebuilt(space, prepared);
  const Skeleton& skeleton = *space.skeleton;
  if (space.representation != Representation::points) {
    for (std::size_t i = 0; i < space.joints.size(); ++i) {
      work.check();
      for (std::size_t t = 0; t < channels.columns; ++t)
        rebuilt.set_local(space.joints[i], t, rotation_at(space, i, channels, t));
    }
    return rebuilt.finish();
  }
  const auto known = flags_of(space);
  const PointsToRotations solve(skeleton, known);
  if (!limbs) rebuilt.give_translations(known);
  RootedPose pose;
  std::vector<Vec3> positions(skeleton.joints.size());
  std::vector<Quat> world(skeleton.joints.size());
  for (std::size_t t = 0; t < channels.columns; ++t) {
    if (t % 64 == 0) work.check();
    rooted_pose(space, prepared, t, pose);
    positions = pose.positions;
    for (std::size_t i = 0; i < space.joints.size(); ++i) positions[space.joints[i]] = vector_at(channels, 3 * i, t);
    if (known[0]) {  // the root was taken out: what edits left of it is a shift of everything
      const Vec3 root = positions[0];
      for (int joint : space.joints) positions[joint] -= root;
    }
    solve.frame(positions, pose.local, pose.world, world);
    for (int j = 0; j < skeleton.size(); ++j) {
      const int parent = skeleton.joints[j].parent;
      rebuilt.set_local(j, t, parent < 0 ? world[j] : inverse(world[parent]) * world[j]);
      if (parent >= 0 && !limbs && known[j] && known[parent])
        rebuilt.set_translation(j, t, rotate(inverse(world[parent]), positions[j] - positions[parent]));
    }
  }
  return rebuilt.finish();
}

Points points_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base, Work& work) {
  Points out(space.labels, base.fps(), channels.columns);
  const Prepared prepared(space, base, work);
  const bool turned = space.heading;
  if (space.representation == Representation::points) {
    const RestPose rest = rest_pose(base.skeleton());
    for (std::size_t i = 0; i < space.labels.size(); ++i) {
      auto track = out.track(static_cast<int>(i));
      for (std::size_t t = 0; t < channels.columns; ++t) {
        const Vec3 v = vector_at(channels, 3 * i, t);
        const Vec3 root = base.translates(0) ? base.skeleton().above_offset +
                                                   rotate(base.skeleton().above, base.skeleton().above_scale *
                                                                                     base.translation(0)[t])
                                             : rest.positions[0];
        track.set(t, root + (turned ? rotate(about_y(prepared.root().heading[t]), v) : v));
      }
    }
    return out;
  }
  const Motion motion = motion_from_channels(space, channels, base, true, work);
  const auto all = std::static_pointer_cast<const Points>(points_of_motion(motion));
  for (std::size_t i = 0; i < space.labels.size(); ++i) {
    const auto from = all->track(motion.skeleton().find(space.labels[i]));
    auto to = out.track(static_cast<int>(i));
    for (std::size_t t = 0; t < channels.columns; ++t) to.set(t, from[t]);
  }
  return out;
}

Points points_from_channels(const ChannelSpace& space, const Rows& channels, const Points& base) {
  Points out(space.labels, base.fps, channels.columns);
  out.unit = base.unit;
  out.unit_name = base.unit_name;
  out.up = base.up;
  out.links = base.links;
  for (std::size_t i = 0; i < space.labels.size(); ++i) {
    auto to = out.track(static_cast<int>(i));
    for (std::size_t t = 0; t < channels.columns; ++t) to.set(t, vector_at(channels, 3 * i, t));
  }
  return out;
}

}  // namespace kinegraph
