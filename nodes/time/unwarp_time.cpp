#include "nodes/time/unwarp_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/time/features.h"
#include "nodes/time/frame_times.h"

namespace kinegraph {
namespace {

// A motion by source frames before the root is put together. `motion` holds the joints below the root and the
// translations; with one path a DOF, `v` holds the rotations of all joints as vectors instead.
struct Parts {
  Motion motion;
  EncodedRoot root;
  Series v;
};

bool is_per_dof(const Warp& warp) {
  return !warp.dofs.empty();
}

std::vector<Quat> bases_of_warp(const Warp& warp) {
  std::vector<Quat> means(warp.means.size() / 4);
  for (std::size_t j = 0; j < means.size(); ++j) {
    const double* m = &warp.means[4 * j];
    means[j] = {m[0], m[1], m[2], m[3]};
  }
  return means;
}

std::vector<int> joints_that_shift(const Motion& motion) {
  std::vector<int> joints;
  for (int j = 1; j < motion.joints(); ++j)
    if (motion.translates(j)) joints.push_back(j);
  return joints;
}

template <class Rotation>
Quat rotation_at(const Rotation& rows, double time) {
  const auto low = static_cast<std::size_t>(std::floor(time));
  const double part = time - static_cast<double>(low);
  return part > 0 ? slerp(part, rows[low], rows[low + 1]) : rows[low];
}

std::size_t logs_of(const Motion& motion, const Warp& warp) {
  const auto joints = static_cast<std::size_t>(motion.joints());
  return 3 * (joints + joints_that_shift(motion).size()) + (is_per_dof(warp) ? 0 : joints);
}

// How far a joint turns between the shown neighbours of a skipped frame.
double neighbours_turn(const Motion& motion, const EncodedRoot& root, int joint, const FrameTimes& times,
                       std::size_t frame) {
  const std::size_t before = times.before[frame], after = times.after[frame];
  if (joint == 0) return turn(root.rho[before], root.rho[after]);
  return turn(motion.rotation(joint)[before], motion.rotation(joint)[after]);
}

// By how much to enlarge what was missed where an edit has enlarged the motion (StyleTransfer's σr/σs): else
// skipped frames would stand out from their neighbours. 1 for an unedited motion.
double gain_of(double turn_now, double turn_then) {
  constexpr double too_small_to_tell = 1e-5, most = 4;
  return turn_then > too_small_to_tell ? std::min(turn_now / turn_then, most) : 1;
}

// Everything but what skipped frames miss.
Parts parts_by_frame(const Motion& rows, const Warp& warp, Work& work) {
  const std::size_t frames = warp.source_frames;
  const EncodedRoot encoded = encode_root(rows, work);
  const auto path_of = path_of_each_dof(warp, rows.skeleton());
  std::vector<FrameTimes> times;
  for (const auto& path : warp.paths) times.push_back(frame_times(path, frames));
  const auto joints = static_cast<std::size_t>(rows.joints());
  const FrameTimes& common = times.back();  // shared: the only one; per-dof: that of "*"

  Parts parts{rows.empty_like(frames), {}, {}};
  parts.root.fps = encoded.fps;
  parts.root.start = encoded.start;
  parts.root.start_heading = encoded.start_heading;
  for (int axis = 0; axis < root_axes; ++axis) {
    const FrameTimes& own = times[path_of[3 * joints + static_cast<std::size_t>(axis)]];
    const bool difference = axis != 2;
    auto& values = root_axis(parts.root, axis);
    values = averaged(root_axis(encoded, axis), own, difference ? 1 : 0);
    // What is left off stands still, and the path goes on from there with the first frame shown.
    for (std::size_t f = 0; difference && f < frames; ++f)
      if (own.left_off(f) || (f == own.first_shown && f > 0)) values[f] = 0;
  }
  parts.root.rho.resize(frames);

  const Series v = is_per_dof(warp) ? carried_vectors(bases_of_warp(warp), rows, encoded, work) : Series();
  if (is_per_dof(warp)) parts.v = Series(frames, 3 * joints);
  work.parallel(joints, 1 + 20'000 / frames, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      work.check();
      const int joint = static_cast<int>(j);
      if (is_per_dof(warp)) {
        for (std::size_t d = 3 * j; d < 3 * j + 3; ++d)
          for (std::size_t f = 0; f < frames; ++f)
            parts.v.dim(d)[f] = sampled(v.dim(d), times[path_of[d]].row[f]);
      } else if (joint == 0) {
        for (std::size_t f = 0; f < frames; ++f) parts.root.rho[f] = rotation_at(encoded.rho, common.row[f]);
      } else {
        const ConstQuatTrack from = rows.rotation(joint);
        const QuatTrack to = parts.motion.rotation(joint);
        for (std::size_t f = 0; f < frames; ++f) to.set(f, rotation_at(from, common.row[f]));
      }
      if (joint > 0 && rows.translates(joint)) {
        const ConstVec3Track from = rows.translation(joint);
        const Vec3Track to = parts.motion.translation(joint);
        for (std::size_t f = 0; f < frames; ++f) {
          const double time = common.row[f];
          to.set(f, {sampled(from.x, time), sampled(from.y, time), sampled(from.z, time)});
        }
      }
    }
  });
  return parts;
}

void add_skipped(Parts& parts, const Warp& warp) {
  if (warp.skipped.empty()) return;
  const auto joints = static_cast<std::size_t>(parts.motion.joints());
  const FrameTimes times = frame_times(warp.paths.back(), parts.motion.frames());
  const auto shifting = joints_that_shift(parts.motion);
  for (const SkippedFrame& skipped : warp.skipped) {
    const std::size_t f = skipped.frame;
    parts.root.d_x[f] += skipped.d_x;
    parts.root.d_z[f] += skipped.d_z;
    parts.root.d_heading[f] += skipped.d_heading;
    parts.root.height[f] += skipped.height;
    for (std::size_t j = 0; j < joints; ++j) {
      Vec3 missed{skipped.logs[3 * j], skipped.logs[3 * j + 1], skipped.logs[3 * j + 2]};
      if (!is_per_dof(warp)) {
        const double then = skipped.logs[3 * (joints + shifting.size()) + j];
        missed *= gain_of(neighbours_turn(parts.motion, parts.root, static_cast<int>(j), times, f), then);
      }
      if (is_per_dof(warp)) {
        for (int axis = 0; axis < 3; ++axis)
          parts.v.dim(3 * j + static_cast<std::size_t>(axis))[f] += missed[axis];
      } else if (j == 0) {
        parts.root.rho[f] = exp(missed) * parts.root.rho[f];
      } else {
        const QuatTrack track = parts.motion.rotation(static_cast<int>(j));
        track.set(f, exp(missed) * track[f]);
      }
    }
    for (std::size_t k = 0; k < shifting.size(); ++k) {
      const Vec3Track track = parts.motion.translation(shifting[k]);
      const double* missed = &skipped.logs[3 * (joints + k)];
      track.set(f, track[f] + Vec3{missed[0], missed[1], missed[2]});
    }
  }
}

void put_together(Parts& parts, const Warp& warp) {
  const std::size_t frames = parts.motion.frames();
  if (is_per_dof(warp)) {
    const auto bases = bases_of_warp(warp);
    for (std::size_t j = 0; j < bases.size(); ++j) {
      const QuatTrack track = parts.motion.rotation(static_cast<int>(j));
      for (std::size_t f = 0; f < frames; ++f) {
        const Vec3 v{parts.v.at(3 * j, f), parts.v.at(3 * j + 1, f), parts.v.at(3 * j + 2, f)};
        const Quat q = carried_rotation(bases, j, v);
        if (j == 0)
          parts.root.rho[f] = q;
        else
          track.set(f, q);
      }
    }
  }
  decode_root(parts.root, parts.motion);
  for (int j = 0; j < parts.motion.joints(); ++j) {
    const QuatTrack track = parts.motion.rotation(j);
    make_continuous(track.x, track.y, track.z, track.w);
  }
}

void check_fits(const Motion& motion, const Warp& warp) {
  const std::size_t rows = warp.source_warped ? warp.reference_frames : warp.source_frames;
  if (motion.frames() != rows)
    throw Failure(error("wrong-length",
                        fmt::format("the motion has {} frames, the warp's clock {}", motion.frames(), rows))
                      .at_port("motion")
                      .hinting("give it `warped`, or that motion edited without a change of its timing"));
  if (!warp.source_warped) return;
  const auto joints = static_cast<std::size_t>(motion.joints());
  const std::size_t logs = logs_of(motion, warp);
  const bool means_fit = !is_per_dof(warp) || warp.means.size() == 4 * joints;
  const bool logs_fit = std::all_of(warp.skipped.begin(), warp.skipped.end(),
                                    [&](const SkippedFrame& frame) { return frame.logs.size() == logs; });
  if (!means_fit || !logs_fit)
    throw Failure(error("wrong-skeleton", "the motion's joints are not those of the motion that was warped")
                      .at_port("motion")
                      .hinting("give it `warped`, or that motion edited on the same skeleton"));
}

void warn_of_ends(const Warp& warp, Work& work) {
  std::uint32_t first = 0, last = warp.source_frames - 1;
  for (const auto& path : warp.paths) {
    first = std::max(first, path.front());
    last = std::min(last, path.back());
  }
  if (first == 0 && last + 1 == warp.source_frames) return;
  work.report(
      warning(
          "frames-left-off",
          fmt::format("the warp left off {} frames at the start and {} at the end: they hold the nearest row",
                      first, warp.source_frames - 1 - last))
          .hinting("ends: fixed keeps them"));
}

}  // namespace

std::vector<std::size_t> path_of_each_dof(const Warp& warp, const Skeleton& skeleton) {
  const auto dofs = all_dofs(skeleton);
  std::vector<std::size_t> paths(dofs.size(), warp.paths.size() - 1);
  for (std::size_t k = 0; k + 1 < warp.dofs.size(); ++k) {
    bool found = false;
    for (std::size_t d = 0; d < dofs.size() && !found; ++d) {
      found = name_of(dofs[d], skeleton) == warp.dofs[k];
      if (found) paths[d] = k;
    }
    if (!found)
      throw Failure(error("wrong-skeleton",
                          fmt::format("the warp has a path for {}, which the motion lacks", warp.dofs[k]))
                        .at_port("motion"));
  }
  return paths;
}

Motion unwarp_time(const Motion& motion, const Warp& warp, Work& work) {
  if (warp.identity) return motion;
  check_fits(motion, warp);
  if (!warp.source_warped) return motion;
  Parts parts = parts_by_frame(motion.translates(0) ? motion : motion.with_translation(0), warp, work);
  add_skipped(parts, warp);
  put_together(parts, warp);
  warn_of_ends(warp, work);
  return std::move(parts.motion);
}

std::vector<SkippedFrame> skipped_frames(const Motion& source, const EncodedRoot& root, const Motion& warped,
                                         const Warp& warp, Work& work) {
  std::vector<bool> skipped(source.frames());
  std::vector<FrameTimes> times;
  for (const auto& path : warp.paths) {
    times.push_back(frame_times(path, source.frames()));
    for (std::size_t f = 0; f < skipped.size(); ++f)
      if (times.back().skipped(f)) skipped[f] = true;
  }
  std::vector<SkippedFrame> all;
  if (std::find(skipped.begin(), skipped.end(), true) == skipped.end()) return all;

  const Parts parts = parts_by_frame(warped, warp, work);
  const auto joints = static_cast<std::size_t>(source.joints());
  const auto shifting = joints_that_shift(source);
  const auto path_of = path_of_each_dof(warp, source.skeleton());
  const Series v = is_per_dof(warp) ? carried_vectors(bases_of_warp(warp), source, root, work) : Series();
  for (std::size_t f = 0; f < skipped.size(); ++f) {
    if (!skipped[f]) continue;
    // In a per-dof warp a frame may be skipped by some DOFs only.
    const auto skips = [&](std::size_t dof) { return times[path_of[dof]].skipped(f); };
    const auto missed_by_root = [&](int axis) {
      if (!skips(3 * joints + static_cast<std::size_t>(axis))) return 0.0;
      return root_axis(root, axis)[f] - root_axis(parts.root, axis)[f];
    };
    SkippedFrame frame;
    frame.frame = static_cast<std::uint32_t>(f);
    frame.d_x = missed_by_root(0);
    frame.d_z = missed_by_root(1);
    frame.height = missed_by_root(2);
    frame.d_heading = missed_by_root(3);
    for (std::size_t j = 0; j < joints; ++j) {
      const int joint = static_cast<int>(j);
      Vec3 missed;
      if (is_per_dof(warp)) {
        for (int axis = 0; axis < 3; ++axis) {
          const std::size_t d = 3 * j + static_cast<std::size_t>(axis);
          if (skips(d)) missed[axis] = v.at(d, f) - parts.v.at(d, f);
        }
      } else {
        const Quat is = j == 0 ? root.rho[f] : source.rotation(joint)[f];
        const Quat got = j == 0 ? parts.root.rho[f] : parts.motion.rotation(joint)[f];
        missed = log(nearer(is * inverse(got), Quat{}));
      }
      frame.logs.insert(frame.logs.end(), {missed.x, missed.y, missed.z});
    }
    for (int joint : shifting) {
      const Vec3 missed = !times.back().skipped(f)
                              ? Vec3{}
                              : source.translation(joint)[f] - parts.motion.translation(joint)[f];
      frame.logs.insert(frame.logs.end(), {missed.x, missed.y, missed.z});
    }
    for (int j = 0; j < source.joints() && !is_per_dof(warp); ++j)
      frame.logs.push_back(neighbours_turn(source, root, j, times.back(), f));
    all.push_back(std::move(frame));
  }
  return all;
}

}  // namespace kinegraph
