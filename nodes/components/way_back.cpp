#include <algorithm>
#include <utility>

#include "nodes/components/channels.h"
#include "nodes/components/decomposed_pose.h"
#include "nodes/components/points_to_rotations.h"
#include "nodes/components/stabilised_points.h"
#include "nodes/motion/track_kernels.h"

namespace kinegraph {
namespace {

std::vector<bool> flags_of(const ChannelSpace& space) {
  std::vector<bool> flags(space.skeleton->joints.size(), false);
  for (int joint : space.joints) flags[joint] = true;
  return flags;
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
std::vector<bool> turning_joints(const ChannelSpace& space, const DecomposedPose& prepared) {
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
  Rebuilt(const ChannelSpace& space, const DecomposedPose& base, bool keep_root)
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
  // The same from orientations in the frame that is decomposed, of frames from `begin` on.
  void set_world(const Skeleton& skeleton, std::size_t begin, const JointRotations& world) {
    for (int j = 0; j < skeleton.size(); ++j) {
      const int at = base_.joint(j), parent = skeleton.joints[j].parent;
      if (at > 0 && parent >= 0) {
        const QuatTrack track = motion_.rotation(at);
        const auto part = [&](std::span<double> all) { return all.subspan(begin, world.frames()); };
        compose_tracks(world[parent], true, world[j],
                       {part(track.x), part(track.y), part(track.z), part(track.w)});
        continue;
      }
      for (std::size_t t = 0; t < world.frames(); ++t)
        set_local(j, begin + t, parent < 0 ? world[j][t] : inverse(world[parent][t]) * world[j][t]);
    }
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
  const DecomposedPose& base_;
  bool keep_root_;
  Motion motion_;
  std::vector<Quat> rho_;
};

// Positions of frames from `begin` on, as many as `base` has, the root at the origin: the chosen joints' as
// the numbers say, the others' as the base's.
void positions_at(const ChannelSpace& space, const Rows& channels, std::size_t begin, const RootedPoses& base,
                  const std::vector<bool>& known, JointPositions& positions) {
  positions = base.positions;
  const std::size_t frames = base.frames();
  const auto put = [&](std::span<double> to, const double* row, const double* origin) {
    for (std::size_t t = 0; t < frames; ++t)
      to[t] = origin ? row[begin + t] - origin[begin + t] : row[begin + t];
  };
  // The root was taken out: what edits left of it is a shift of everything.
  const double* origin[3] = {};
  for (std::size_t i = 0; known[0] && i < space.joints.size(); ++i)
    if (space.joints[i] == 0)
      for (std::size_t c = 0; c < 3; ++c) origin[c] = channels.row(3 * i + c);
  for (std::size_t i = 0; i < space.joints.size(); ++i) {
    const Vec3Track track = positions[space.joints[i]];
    put(track.x, channels.row(3 * i), origin[0]);
    put(track.y, channels.row(3 * i + 1), origin[1]);
    put(track.z, channels.row(3 * i + 2), origin[2]);
  }
}

// From the root outwards, child = parent + rest length × direction [Shapiro §3.2]. Joints whose parent isn't
// known, and links without a direction, move with their parent.
void restore_lengths(const Skeleton& bones, const std::vector<bool>& known, JointPositions& positions) {
  const JointPositions before = positions;
  for (int j = 1; j < bones.size(); ++j) {
    const int parent = bones.joints[j].parent;
    if (!known[j] || !known[parent]) continue;
    const double rest = bones.link_length(j);
    for (std::size_t t = 0; t < positions.frames(); ++t) {
      const Vec3 link = before[j][t] - before[parent][t], start = positions[parent][t];
      const double length = norm(link);
      if (rest < 1e-9)
        positions[j].set(t, start);
      else
        positions[j].set(t, start + (length > 1e-9 ? rest / length * link : link));
    }
  }
}

// Links as the positions have them, where a joint's translation varies; with limbs of the rest's length.
void set_translations(const Skeleton& skeleton, const std::vector<bool>& known, std::size_t begin,
                      const JointPositions& positions, const JointRotations& world, bool limbs,
                      Rebuilt& rebuilt) {
  for (int j = 1; j < skeleton.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    if (!known[j] || !known[parent] || !rebuilt.translates(j)) continue;
    const double rest = skeleton.link_length(j);
    for (std::size_t t = 0; t < world.frames(); ++t) {
      const Vec3 link = rotate(inverse(world[parent][t]), positions[j][t] - positions[parent][t]);
      const double length = norm(link);
      if (!limbs)
        rebuilt.set_translation(j, begin + t, link);
      else if (length > 1e-9 && rest > 1e-9)
        rebuilt.set_translation(j, begin + t, rest / length * link);
    }
  }
}

Motion motion_from_positions(const ChannelSpace& space, const Rows& channels, const DecomposedPose& base,
                             const WayBack& way, Work& work) {
  Rebuilt rebuilt(space, base, way.root);
  const Skeleton& skeleton = base.skeleton();
  const auto known = flags_of(space);
  const PointsToRotations solve(skeleton, known, turning_joints(space, base));
  if (!way.limbs) rebuilt.give_translations(known);
  work.parallel(channels.columns, 4 * frames_at_a_time, [&](std::size_t first, std::size_t last) {
    RootedPoses poses;
    JointPositions positions;
    JointRotations world;
    for (std::size_t begin = first; begin < last; begin += frames_at_a_time) {
      work.check();
      rooted_poses(base, begin, std::min(last, begin + frames_at_a_time), poses);
      positions_at(space, channels, begin, poses, known, positions);
      if (world.frames() != poses.frames()) world = JointRotations(skeleton.joints.size(), poses.frames());
      solve.frames(positions, poses, world);
      rebuilt.set_world(skeleton, begin, world);
      set_translations(skeleton, known, begin, positions, world, way.limbs, rebuilt);
    }
  });
  return rebuilt.finish();
}

}  // namespace

Motion motion_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base,
                            const WayBack& way, Work& work) {
  const DecomposedPose prepared(space, base, work);
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
  const DecomposedPose prepared(space, base, work);
  const auto known = flags_of(space);
  const double scale = base.skeleton().above_scale;
  double mean_height = 0;
  for (double y : prepared.root().height) mean_height += y / static_cast<double>(channels.columns);
  RootedPoses poses;
  JointPositions positions;
  for (std::size_t begin = 0; begin < channels.columns; begin += frames_at_a_time) {
    work.check();
    rooted_poses(prepared, begin, std::min(channels.columns, begin + frames_at_a_time), poses);
    positions_at(space, channels, begin, poses, known, positions);
    if (way.limbs) restore_lengths(prepared.skeleton(), known, positions);
    for (std::size_t t = begin; t < begin + poses.frames(); ++t) {
      const Vec3 root = way.root ? prepared.root_place(t) : Vec3{0, mean_height, 0};
      const Quat facing = way.root ? prepared.root_facing(t) : Quat{};
      for (std::size_t i = 0; i < space.joints.size(); ++i)
        out.track(static_cast<int>(i))
            .set(t, root + scale * rotate(facing, positions[space.joints[i]][t - begin]));
    }
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
