#include "nodes/judge/other_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

namespace {

bool has_positions(const BvhJoint& joint) {
  return std::any_of(joint.channels.begin(), joint.channels.end(), [](const auto& c) { return c[1] == 'p'; });
}

// Joints one of whose angles, as read, goes half a turn or more from one frame to the next while the joint
// turns by less than a quarter; the first such frame of the first of them.
struct Wraps {
  std::vector<std::string> joints;
  std::size_t frame = 0;
};
Wraps wraps_of(const Motion& motion) {
  Wraps wraps;
  const SourceFacts& source = motion.source();
  if (!source.read || source.read_frames != motion.frames()) return wraps;
  std::size_t channels = 0;
  for (const BvhJoint& joint : source.bvh) channels += joint.channels.size();
  if (channels == 0) return wraps;
  const std::size_t length = source.read->size() / channels;
  std::size_t channel = 0;
  for (std::size_t j = 0; j < source.bvh.size(); ++j) {
    std::size_t first = motion.frames();
    const auto q = motion.rotation(static_cast<int>(j));
    for (const std::string& name : source.bvh[j].channels) {
      const double* angle = source.read->data() + channel++ * length + source.first_read;
      for (std::size_t t = 1; name[1] == 'r' && t < first; ++t)
        if (std::fabs(angle[t] - angle[t - 1]) >= 180 && turn(q[t - 1], q[t]) < 90 / degrees_per_radian)
          first = t;
    }
    if (first == motion.frames()) continue;
    if (wraps.joints.empty()) wraps.frame = first;
    wraps.joints.push_back(motion.skeleton().joints[j].name);
  }
  return wraps;
}

// Whether the legs stand along Z rather than Y, in most of nine frames over the clip.
bool legs_along_z(const Motion& motion) {
  constexpr std::size_t looked_at = 9;
  if (motion.frames() == 0 || motion.source().up == UpAxis::z) return false;
  const std::vector<Leg> legs = find_legs(motion.skeleton());
  std::size_t along = 0;
  for (std::size_t k = 0; k < looked_at; ++k) {
    const Pose pose = pose_at(motion, (motion.frames() - 1) * k / (looked_at - 1));
    Vec3 sum;
    for (const Leg& leg : legs)
      if (leg.hip >= 0 && leg.ankle >= 0) sum += pose.positions[leg.hip] - pose.positions[leg.ankle];
    along += std::fabs(sum.z) > 0.8 * norm(sum) && std::fabs(sum.y) < 0.4 * norm(sum);
  }
  return 2 * along > looked_at;
}

// Whether a cloud of markers is longest along Z, in most of the frames that show at least half of it: no
// figure on its feet is, taken as it stands.
bool points_along_z(const Points& points) {
  constexpr std::size_t looked_at = 60, few = 8;
  const int labels = static_cast<int>(points.labels.size());
  if (points.labels.size() < few) return false;
  std::size_t seen = 0, along = 0;
  const std::size_t step = std::max<std::size_t>(1, points.frames / looked_at);
  for (std::size_t t = 0; t < points.frames; t += step) {
    Vec3 low, high;
    int there = 0;
    for (int label = 0; label < labels; ++label) {
      if (points.is_missing(label, t)) continue;
      const Vec3 p = points.track(label)[t];
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = there ? std::min(low[axis], p[axis]) : p[axis];
        high[axis] = there ? std::max(high[axis], p[axis]) : p[axis];
      }
      ++there;
    }
    if (2 * there < labels) continue;
    const Vec3 size = high - low;
    ++seen;
    along += size.z > 1.8 * size.y && size.z > 1.4 * size.x;
  }
  return 3 * along > 2 * seen;
}

}  // namespace

std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 4;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < shown; ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

Diagnostics for_other_programs(const Motion& motion) {
  Diagnostics found;
  std::vector<std::string> adds, blanks, paths, bare, cut;
  const bool is_bvh = !motion.source().bvh.empty();
  const int joints = motion.joints();
  std::vector<bool> ends(static_cast<std::size_t>(joints));
  for (const EndSite& end : motion.skeleton().ends) ends[end.joint] = true;
  for (const Joint& joint : motion.skeleton().joints)
    if (joint.parent >= 0) ends[joint.parent] = true;
  for (int j = 0; j < joints; ++j) {
    const std::string& name = motion.skeleton().joints[j].name;
    if (name.find_first_of(" \t") != std::string::npos) blanks.push_back(name);
    if (name.find_first_of(" \t.:/[]") != std::string::npos) paths.push_back(name);
    if (name.size() > 63) cut.push_back(name);
    if (!is_bvh) continue;
    const BvhJoint& channels = motion.source().bvh[j];
    if (has_positions(channels) && channels.offset != Vec3{}) adds.push_back(name);
    if (!ends[j]) bare.push_back(name);
  }
  if (!adds.empty())
    found.push_back(warning("three-adds-offset",
                            "three.js adds OFFSET and position channels where Blender, MotionBuilder "
                            "and Kinegraph take the channels alone: " +
                                some_of(adds)));
  if (!blanks.empty() && is_bvh)
    found.push_back(warning("assimp-names", "Assimp doesn't read BVH names with blanks: " + some_of(blanks)));
  if (!paths.empty() && is_bvh)
    found.push_back(warning("three-names",
                            "three.js takes blanks and . : / [ ] in names for paths, so that these joints "
                            "stand still there: " +
                                some_of(paths)));
  if (!cut.empty())
    found.push_back(warning("long-names", "Blender cuts names off after 63 bytes: " + some_of(cut)));
  if (legs_along_z(motion))
    found.push_back(warning("up-axis", "the legs point along Z, and the file is read as Y up")
                        .hinting("set up to z where the figure lies down")
                        .at_param("up"));
  if (const Wraps wraps = wraps_of(motion); !wraps.joints.empty())
    found.push_back(info("euler-wraps",
                         "angles jump by half a turn or more where the joint hardly turns; programs that "
                         "interpolate or filter them one by one see a spin there: " +
                             some_of(wraps.joints))
                        .at_frame(static_cast<std::int64_t>(wraps.frame)));
  if (!bare.empty())
    found.push_back(info(
        "no-end-site",
        "joints at the end of a chain have no End Site, so programs guess their bone: " + some_of(bare)));
  return found;
}

Diagnostics for_other_programs(const Points& points) {
  if (!points_along_z(points)) return {};
  const bool z = points.up == UpAxis::z;
  return {warning("up-axis", fmt::format("the points stretch along the file's {}, and it is read as {} up",
                                         z ? "Y" : "Z", z ? "Z" : "Y"))
              .hinting(fmt::format("set up to {} where the figure lies down", z ? "y" : "z"))
              .at_param("up")};
}

Diagnostics for_other_programs(const Character& character) {
  std::vector<std::string> beyond;
  double low = 0, high = 1;
  for (const MorphTrack& track : character.morph_tracks) {
    if (track.weights.empty()) continue;
    const auto [least, most] = std::minmax_element(track.weights.begin(), track.weights.end());
    if (*least >= 0 && *most <= 1) continue;
    beyond.push_back(character.parts[track.part].morphs[track.target].name);
    low = std::min(low, *least);
    high = std::max(high, *most);
  }
  if (beyond.empty()) return {};
  return {
      warning("morph-weights", fmt::format("weights of morph targets go from {:.3g} to {:.3g}, and Blender "
                                           "holds them between 0 and 1: {}",
                                           low, high, some_of(beyond)))};
}

}  // namespace kinegraph
