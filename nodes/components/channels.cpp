#include "nodes/components/channels.h"

#include <algorithm>
#include <cmath>

#include "nodes/components/points_to_rotations.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/quaternion_mean.h"

namespace kinegraph {
namespace {

// A motion's rotations in the frame that is decomposed: local ones, the root's with R_y(-ψ) taken out (ρ, in
// world) or in world as it stands.
class Prepared {
 public:
  Prepared(const ChannelSpace& space, const Motion& motion, Work& work)
      : space_(space),
        motion_(motion),
        root_(encode_root(motion, work)),
        joint_of_(joints_of(space, motion.skeleton())),
        skeleton_(*space.skeleton) {
    for (int j = 1; j < skeleton_.size(); ++j) {
      const int at = joint_of_[j];
      if (at <= 0) continue;
      const Vec3 own = motion.skeleton().joints[at].offset;
      if (norm(own) > 1e-9) skeleton_.joints[j].offset = own;
    }
  }
  // `joint` of the space's skeleton; at rest where the motion lacks it.
  Quat local(int joint, std::size_t t) const {
    const int at = joint_of_[joint];
    if (at < 0) return space_.skeleton->joints[joint].rest;
    if (at > 0) return motion_.rotation(at)[t];
    return space_.heading ? root_.rho[t] : about_y(root_.heading[t]) * root_.rho[t];
  }
  // From the parent to `joint`, in the parent's frame: the motion's direction, the space's length.
  Vec3 link(int joint, std::size_t t) const {
    const int at = joint_of_[joint];
    const double own = norm(skeleton_.joints[joint].offset), wanted = space_.skeleton->link_length(joint);
    const Vec3 offset =
        at > 0 && motion_.translates(at) ? motion_.local_offset(at, t) : skeleton_.joints[joint].offset;
    return own > 1e-9 && own != wanted ? wanted / own * offset : offset;
  }
  int joint(int of_space) const { return joint_of_[of_space]; }
  const EncodedRoot& root() const { return root_; }
  const Motion& motion() const { return motion_; }
  bool heading() const { return space_.heading; }
  // The space's joints with this motion's own bones.
  const Skeleton& skeleton() const { return skeleton_; }

 private:
  const ChannelSpace& space_;
  const Motion& motion_;
  EncodedRoot root_;
  std::vector<int> joint_of_;
  Skeleton skeleton_;
};

// Positions of all joints with the root at the origin, and world orientations, in the frame that is
// decomposed.
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
      pose.positions[j] = pose.positions[parent] + rotate(pose.world[parent], prepared.link(j, t));
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
      return normalized(
          Quat{channels(row, t), channels(row + 1, t), channels(row + 2, t), channels(row + 3, t)});
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

// Which joints of the space's skeleton turn at all in this motion.
std::vector<bool> turning_joints(const ChannelSpace& space, const Prepared& prepared) {
  std::vector<bool> turning(space.skeleton->joints.size(), false);
  for (int j = 0; j < space.skeleton->size(); ++j) {
    const int at = prepared.joint(j);
    if (at < 0) continue;
    const auto track = prepared.motion().rotation(at);
    for (std::size_t t = 1; t < prepared.motion().frames() && !turning[j]; ++t)
      turning[j] = turn(track[0], track[t]) > 1e-6;
  }
  return turning;
}

// The base with other rotations (in the frame that is decomposed) and, where given, other local translations.
class Rebuilt {
 public:
  Rebuilt(const ChannelSpace& space, const Prepared& base, bool keep_root)
      : space_(space), base_(base), keep_root_(keep_root), motion_(base.motion()), rho_(base.root().rho) {
    if (!motion_.translates(0)) motion_ = motion_.with_translation(0);
  }

  void give_translations(const std::vector<bool>& joints) {
    for (int j = 1; j < space_.skeleton->size(); ++j) {
      const int at = base_.joint(j);
      if (joints[j] && at > 0 && !motion_.translates(at)) motion_ = motion_.with_translation(at);
    }
  }
  void set_local(int joint, std::size_t t, Quat q) {
    const int at = base_.joint(joint);
    if (at > 0) motion_.rotation(at).set(t, q);
    if (at == 0) rho_[t] = base_.heading() ? q : about_y(-base_.root().heading[t]) * q;
  }
  bool translates(int joint) const {
    return base_.joint(joint) > 0 && motion_.translates(base_.joint(joint));
  }
  void set_translation(int joint, std::size_t t, Vec3 offset) {
    motion_.translation(base_.joint(joint)).set(t, offset);
  }
  Motion finish() {
    EncodedRoot root = base_.root();
    root.rho = std::move(rho_);
    if (!keep_root_) stay_on_the_spot(root);
    const Motion& base = base_.motion();
    decode_root_keeping_heading(root, motion_);
    if (keep_root_) {
      // decode_root integrates the path; the base's own numbers are exact.
      for (std::size_t t = 0; t < motion_.frames(); ++t)
        motion_.translation(0).set(t, base.local_offset(0, t));
    }
    for (int j = 0; j < motion_.joints(); ++j) {
      auto track = motion_.rotation(j);
      make_continuous(track.x, track.y, track.z, track.w);
    }
    return std::move(motion_);
  }

 private:
  // The root at its mean height over the world's origin; with the heading taken out, facing along z.
  void stay_on_the_spot(EncodedRoot& root) const {
    double mean = 0;
    for (double y : root.height) mean += y;
    mean /= static_cast<double>(std::max<std::size_t>(root.frames(), 1));
    root.start = {0, mean, 0};
    for (std::size_t t = 0; t < root.frames(); ++t) {
      root.d_x[t] = root.d_z[t] = 0;
      root.height[t] = mean;
      if (base_.heading()) root.heading[t] = 0;
    }
    if (base_.heading()) root.start_heading = 0;
  }

  const ChannelSpace& space_;
  const Prepared& base_;
  bool keep_root_;
  Motion motion_;
  std::vector<Quat> rho_;
};

// How one frame of Points was moved before its numbers were taken: x' = turn (x - centre).
struct Move {
  Quat turn;
  Vec3 centre;
};
std::vector<int> labels_of(const std::vector<std::string>& wanted, const Points& points) {
  std::vector<int> out;
  for (const std::string& label : wanted) {
    const auto found = std::find(points.labels.begin(), points.labels.end(), label);
    if (found == points.labels.end())
      throw Failure(
          error("label-missing", "a clip has no point '" + label + "'")
              .at_port("motions")
              .at_joint(label)
              .hinting("give clips with the same labels, or choose those they share with `joints`"));
    out.push_back(static_cast<int>(found - points.labels.begin()));
  }
  return out;
}
std::vector<Move> moves_of(const ChannelSpace& space, const Points& points) {
  std::vector<Move> moves(points.frames);
  if (space.stabilise == Stabilise::none) return moves;
  const auto stable = labels_of(space.stable, points);
  std::vector<Vec3> present(stable.size());
  for (std::size_t t = 0; t < points.frames; ++t) {
    Move& move = moves[t];
    for (int label : stable) move.centre += points.track(label)[t];
    move.centre = move.centre / static_cast<double>(stable.size());
    if (space.stabilise == Stabilise::centroid) continue;
    for (std::size_t i = 0; i < stable.size(); ++i) present[i] = points.track(stable[i])[t] - move.centre;
    move.turn = best_rotation(present, space.shape, t > 0 ? moves[t - 1].turn : Quat{});
  }
  return moves;
}
// "3 to 7, 12": the frames where a label is missing.
std::string missing_frames(const Points& points, int label) {
  std::string text;
  for (std::size_t t = 0; t < points.frames; ++t) {
    if (!points.is_missing(label, t)) continue;
    const std::size_t first = t;
    while (t + 1 < points.frames && points.is_missing(label, t + 1)) ++t;
    text +=
        (text.empty() ? "" : ", ") + std::to_string(first) + (t > first ? " to " + std::to_string(t) : "");
  }
  return text;
}
void check_whole(const Points& points, const std::vector<int>& labels) {
  for (int label : labels) {
    const std::string frames = missing_frames(points, label);
    if (frames.empty()) continue;
    throw Failure(
        error("gaps", "the point '" + points.labels[label] + "' is missing at frames " + frames)
            .at_port("motions")
            .at_joint(points.labels[label])
            .hinting("fill longer gaps with Load's `max_gap`, or leave the point out with `joints`"));
  }
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

std::vector<int> joints_of(const ChannelSpace& space, const Skeleton& skeleton) {
  std::vector<int> out;
  bool all = true;
  for (const Joint& joint : space.skeleton->joints) {
    out.push_back(skeleton.find(joint.name));
    all = all && out.back() >= 0;
  }
  return all ? out : partners(skeleton, *space.skeleton, space.map);
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
  for (const auto& one : points) check_whole(*one, labels_of(space.labels, *one));
  if (stabilise == Stabilise::rigid && first.frames > 0) {
    Vec3 centre;
    const auto stable = labels_of(space.stable, first);
    for (int label : stable) centre += first.track(label)[0];
    centre = centre / static_cast<double>(stable.size());
    for (int label : stable) space.shape.push_back(first.track(label)[0] - centre);
  }
  return space;
}

Rows channels_of(const ChannelSpace& space, const Motion& motion, const std::vector<double>& before,
                 Work& work) {
  const Prepared prepared(space, motion, work);
  const std::size_t frames = motion.frames(), per = space.per_label();
  for (std::size_t i = 0; i < space.joints.size(); ++i)
    if (prepared.joint(space.joints[i]) < 0)
      throw Failure(error("joint-missing", "the motion has no joint '" + space.labels[i] + "'")
                        .at_joint(space.labels[i])
                        .hinting("bring it to the components' skeleton with Retarget"));
  Rows out(space.channels(), frames);
  if (space.representation == Representation::points) {
    RootedPose pose;
    for (std::size_t t = 0; t < frames; ++t) {
      if (t % 256 == 0) work.check();
      rooted_pose(space, prepared, t, pose);
      for (std::size_t i = 0; i < space.joints.size(); ++i)
        put(out, i * per, t, pose.positions[space.joints[i]]);
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
  const auto labels = labels_of(space.labels, points);
  check_whole(points, labels);
  const auto moves = moves_of(space, points);
  Rows out(space.channels(), points.frames);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    work.check();
    const auto track = points.track(labels[i]);
    for (std::size_t t = 0; t < points.frames; ++t)
      put(out, 3 * i, t, rotate(moves[t].turn, track[t] - moves[t].centre));
  }
  return out;
}

namespace {

// One frame's positions, the root at the origin: the chosen joints' as the numbers say, the others' as the
// base's.
void positions_at(const ChannelSpace& space, const Rows& channels, std::size_t t, const RootedPose& base,
                  const std::vector<bool>& known, std::vector<Vec3>& positions) {
  positions = base.positions;
  for (std::size_t i = 0; i < space.joints.size(); ++i)
    positions[space.joints[i]] = vector_at(channels, 3 * i, t);
  if (!known[0]) return;
  // The root was taken out: what edits left of it is a shift of everything.
  const Vec3 root = positions[0];
  for (int joint : space.joints) positions[joint] -= root;
}

// From the root outwards, child = parent + rest length × direction [Shapiro §3.2]. Joints whose parent isn't
// known, and links without a direction, move with their parent.
void restore_lengths(const Skeleton& bones, const std::vector<bool>& known, std::vector<Vec3>& positions) {
  const std::vector<Vec3> before = positions;
  for (int j = 1; j < bones.size(); ++j) {
    const int parent = bones.joints[j].parent;
    if (!known[j] || !known[parent]) continue;
    const Vec3 link = before[j] - before[parent];
    const double length = norm(link), rest = bones.link_length(j);
    if (rest < 1e-9)
      positions[j] = positions[parent];
    else
      positions[j] = positions[parent] + (length > 1e-9 ? rest / length * link : link);
  }
}

Motion motion_from_positions(const ChannelSpace& space, const Rows& channels, const Prepared& base,
                             const WayBack& way, Work& work) {
  Rebuilt rebuilt(space, base, way.root);
  const Skeleton& skeleton = base.skeleton();
  const auto known = flags_of(space);
  const PointsToRotations solve(skeleton, known, turning_joints(space, base));
  if (!way.limbs) rebuilt.give_translations(known);
  work.parallel(channels.columns, 128, [&](std::size_t begin, std::size_t end) {
    RootedPose pose;
    std::vector<Vec3> positions(skeleton.joints.size());
    std::vector<Quat> world(skeleton.joints.size());
    for (std::size_t t = begin; t < end; ++t) {
      if (t % 64 == 0) work.check();
      rooted_pose(space, base, t, pose);
      positions_at(space, channels, t, pose, known, positions);
      solve.frame(positions, pose.local, pose.world, world);
      for (int j = 0; j < skeleton.size(); ++j) {
        const int parent = skeleton.joints[j].parent;
        rebuilt.set_local(j, t, parent < 0 ? world[j] : inverse(world[parent]) * world[j]);
        if (parent < 0 || !known[j] || !known[parent] || !rebuilt.translates(j)) continue;
        const Vec3 link = rotate(inverse(world[parent]), positions[j] - positions[parent]);
        const double length = norm(link), rest = skeleton.link_length(j);
        if (!way.limbs)
          rebuilt.set_translation(j, t, link);
        else if (length > 1e-9 && rest > 1e-9)
          rebuilt.set_translation(j, t, rest / length * link);
      }
    }
  });
  return rebuilt.finish();
}

}  // namespace

Motion motion_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base,
                            const WayBack& way, Work& work) {
  const Prepared prepared(space, base, work);
  if (space.representation == Representation::points)
    return motion_from_positions(space, channels, prepared, way, work);
  Rebuilt rebuilt(space, prepared, way.root);
  work.parallel(space.joints.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      work.check();
      for (std::size_t t = 0; t < channels.columns; ++t)
        rebuilt.set_local(space.joints[i], t, rotation_at(space, i, channels, t));
    }
  });
  return rebuilt.finish();
}

Points points_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base,
                            const WayBack& way, Work& work) {
  Points out(space.labels, base.fps(), channels.columns);
  out.unit = base.source().unit;
  out.unit_name = base.source().unit_name;
  out.up = base.source().up;
  for (std::size_t i = 0; i < space.joints.size(); ++i) {
    const int parent = space.skeleton->joints[space.joints[i]].parent;
    const auto at = std::find(space.joints.begin(), space.joints.end(), parent);
    if (at != space.joints.end())
      out.links.emplace_back(static_cast<int>(i), static_cast<int>(at - space.joints.begin()));
  }
  if (space.representation != Representation::points) {
    const Motion motion = motion_from_channels(space, channels, base, way, work);
    const auto all = std::static_pointer_cast<const Points>(points_of_motion(motion));
    const auto joints = joints_of(space, motion.skeleton());
    for (std::size_t i = 0; i < space.labels.size(); ++i) {
      const auto from = all->track(joints[space.joints[i]]);
      for (std::size_t t = 0; t < channels.columns; ++t) out.track(static_cast<int>(i)).set(t, from[t]);
    }
    return out;
  }
  const Prepared prepared(space, base, work);
  const auto known = flags_of(space);
  const Skeleton& bones = base.skeleton();
  double mean_height = 0;
  for (double y : prepared.root().height) mean_height += y / static_cast<double>(channels.columns);
  RootedPose pose;
  std::vector<Vec3> positions;
  for (std::size_t t = 0; t < channels.columns; ++t) {
    if (t % 64 == 0) work.check();
    rooted_pose(space, prepared, t, pose);
    positions_at(space, channels, t, pose, known, positions);
    if (way.limbs) restore_lengths(prepared.skeleton(), known, positions);
    const Vec3 root =
        way.root ? bones.above_offset + rotate(bones.above, bones.above_scale * base.local_offset(0, t))
                 : Vec3{0, mean_height, 0};
    const Quat facing = space.heading && way.root ? about_y(prepared.root().heading[t]) : Quat{};
    for (std::size_t i = 0; i < space.joints.size(); ++i)
      out.track(static_cast<int>(i))
          .set(t, root + bones.above_scale * rotate(facing, positions[space.joints[i]]));
  }
  return out;
}

Points points_from_channels(const ChannelSpace& space, const Rows& channels, const Points& base,
                            const WayBack& way) {
  Points out(space.labels, base.fps, channels.columns);
  out.unit = base.unit;
  out.unit_name = base.unit_name;
  out.up = base.up;
  if (base.labels == space.labels) out.links = base.links;
  const auto moves = way.root ? moves_of(space, base) : std::vector<Move>(base.frames);
  for (std::size_t i = 0; i < space.labels.size(); ++i) {
    auto to = out.track(static_cast<int>(i));
    for (std::size_t t = 0; t < channels.columns; ++t)
      to.set(t, moves[t].centre + rotate(inverse(moves[t].turn), vector_at(channels, 3 * i, t)));
  }
  return out;
}

}  // namespace kinegraph
