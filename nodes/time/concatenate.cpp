#include "nodes/time/concatenate.h"

#include <fmt/format.h>

#include <cmath>

#include "graph/diagnostic.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/node_params.h"

namespace kinegraph {

namespace {

[[noreturn]] void refuse(std::string code, std::string what, std::string hint, std::string joint = {}) {
  throw Failure(error(std::move(code), std::move(what))
                    .at_port("motions")
                    .at_joint(std::move(joint))
                    .hinting(std::move(hint)));
}

// A motion with the first one's skeleton: the same joints in the first one's order, its lengths.
Motion on_skeleton_of(const Motion& first, const Motion& motion, std::size_t index) {
  const Skeleton& ours = first.skeleton();
  const Skeleton& theirs = motion.skeleton();
  auto parent_name = [](const Skeleton& s, int joint) {
    return s.joints[joint].parent < 0 ? std::string() : s.joints[s.joints[joint].parent].name;
  };
  std::vector<int> from(ours.joints.size());
  std::vector<bool> translates(ours.joints.size());
  for (int j = 0; j < ours.size(); ++j) {
    const std::string& name = ours.joints[j].name;
    from[j] = theirs.find(name);
    if (from[j] < 0)
      refuse("different-joints",
             fmt::format("motion {} has no joint \"{}\", which the first has", index, name),
             "join motions of one skeleton, or put a Retarget node before", name);
    if (parent_name(ours, j) != parent_name(theirs, from[j]))
      refuse("different-joints",
             fmt::format("\"{}\" hangs on another joint in motion {} than in the first", name, index),
             "join motions of one skeleton, or put a Retarget node before", name);
    translates[j] = motion.translates(from[j]);
  }
  if (theirs.size() != ours.size()) {
    for (const Joint& joint : theirs.joints)
      if (ours.find(joint.name) < 0)
        refuse("different-joints",
               fmt::format("motion {} has a joint \"{}\", which the first lacks", index, joint.name),
               "join motions of one skeleton, or put a Retarget node before", joint.name);
  }
  Motion result(first.shared_skeleton(), first.shared_source(), first.fps(), motion.frames(), translates);
  for (int j = 0; j < ours.size(); ++j) {
    for (std::size_t t = 0; t < motion.frames(); ++t) result.rotation(j).set(t, motion.rotation(from[j])[t]);
    if (!translates[j]) continue;
    for (std::size_t t = 0; t < motion.frames(); ++t)
      result.translation(j).set(t, motion.translation(from[j])[t]);
  }
  return result;
}

// Where a root stands on the ground and which way it faces.
struct Stance {
  double x = 0, z = 0, heading = 0;
};
std::vector<Stance> stances(const EncodedRoot& root) {
  std::vector<Stance> all;
  Stance at{root.start.x, root.start.z, root.start_heading};
  for (std::size_t t = 0; t < root.frames(); ++t) {
    if (t > 0) {
      auto [sin, cos] = sin_cos(at.heading);
      at.x += (cos * root.d_x[t] + sin * root.d_z[t]) / root.fps;
      at.z += (cos * root.d_z[t] - sin * root.d_x[t]) / root.fps;
    }
    at.heading = root.heading[t];
    all.push_back(at);
  }
  return all;
}
// At a place between frames; past the last frame it goes on as it went.
Stance stance_at(const std::vector<Stance>& all, double frame) {
  if (all.size() == 1) return all[0];
  double lower = std::floor(std::fmin(std::fmax(frame, 0), static_cast<double>(all.size() - 2)));
  const Stance& a = all[static_cast<std::size_t>(lower)];
  const Stance& b = all[static_cast<std::size_t>(lower) + 1];
  double u = frame - lower;
  return {a.x + u * (b.x - a.x), a.z + u * (b.z - a.z), a.heading + u * (b.heading - a.heading)};
}

// Turned about up and moved on the ground so that its root at `frame` stands where `wished` is.
Motion moved_to(const Motion& motion, Stance wished, double frame, Work& work) {
  EncodedRoot root = encode_root(motion, work);
  Stance now = stance_at(stances(root), frame);
  double angle = wished.heading - now.heading;
  angle -= 2 * pi * std::floor(angle / (2 * pi) + 0.5);
  auto [sin, cos] = sin_cos(angle);
  double x = root.start.x - now.x, z = root.start.z - now.z;
  root.start.x = wished.x + cos * x + sin * z;
  root.start.z = wished.z + cos * z - sin * x;
  root.start_heading += angle;
  for (double& heading : root.heading) heading += angle;
  Motion result = motion.with_translation(0);
  decode_root_keeping_heading(root, result);
  return result;
}

double faded(double u) {
  return u * u * (3 - 2 * u);
}

// `first` and then `second`, of which `overlap` frames lie on each other.
Motion joined(const Motion& first, const Motion& second, std::size_t overlap) {
  auto translates = first.translating();
  for (int j = 0; j < first.joints(); ++j)
    if (second.translates(j)) translates[j] = true;
  std::size_t begin = first.frames() - overlap, frames = begin + second.frames();
  Motion result(first.shared_skeleton(), first.shared_source(), first.fps(), frames, translates);
  for (int j = 0; j < first.joints(); ++j) {
    auto a = first.rotation(j), b = second.rotation(j);
    auto out = result.rotation(j);
    for (std::size_t t = 0; t < frames; ++t) {
      double u = faded(static_cast<double>(t - begin + 1) / static_cast<double>(overlap + 1));
      out.set(t, t < begin ? a[t] : t >= first.frames() ? b[t - begin] : slerp(u, a[t], b[t - begin]));
    }
    make_continuous(out.x, out.y, out.z, out.w);
    if (!translates[j]) continue;
    auto place = result.translation(j);
    for (std::size_t t = 0; t < frames; ++t) {
      if (t < begin) {
        place.set(t, first.local_offset(j, t));
        continue;
      }
      Vec3 to = second.local_offset(j, t - begin);
      if (t < first.frames()) {
        double u = faded(static_cast<double>(t - begin + 1) / static_cast<double>(overlap + 1));
        Vec3 from = first.local_offset(j, t);
        to = from + u * (to - from);
      }
      place.set(t, to);
    }
  }
  return result;
}

}  // namespace

Motion concatenated(const std::vector<const Motion*>& motions, const ConcatenateSettings& settings,
                    Work& work) {
  const Motion& first = *motions.front();
  if (motions.size() == 1) return first;
  Motion result = first;
  result.set_source(without_read(first.shared_source()));
  auto overlap = static_cast<std::size_t>(std::floor(settings.blend * first.fps() + 0.5));
  for (std::size_t i = 1; i < motions.size(); ++i) {
    work.check();
    const Motion& given = *motions[i];
    check_same_rate(first.fps(), given.fps(), "the first motion", "motions");
    Motion next = on_skeleton_of(result, given, i);
    if (next.frames() == 0) continue;
    if (result.frames() == 0) {
      result = std::move(next);
      continue;
    }
    if (overlap > result.frames() || overlap > next.frames()) {
      refuse("too-short",
             fmt::format("an overlap of {} frames is longer than motion {} or the one before it", overlap, i),
             "choose a shorter blend");
    }
    if (settings.align_root) {
      double middle =
          0.5 * (static_cast<double>(overlap) - 1);  // of the overlap, in the next motion's frames
      if (overlap == 0) middle = 0;
      double before = static_cast<double>(result.frames() - overlap) + middle;
      Stance wished = stance_at(stances(encode_root(result, work)), before);
      next = moved_to(next, wished, middle, work);
    }
    result = joined(result, next, overlap);
    work.progress(static_cast<double>(i) / static_cast<double>(motions.size()));
  }
  return result;
}

}  // namespace kinegraph
