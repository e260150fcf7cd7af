#include "nodes/style/quat_stats.h"

#include <cmath>
#include <cstddef>

#include "nodes/motion/quaternion_mean.h"
#include "nodes/motion/rotation_channels.h"
#include "nodes/style/euler_channels.h"

namespace kinegraph {

namespace {

struct MeanSpread {
  double mean = 0;
  double spread = 0;
};

MeanSpread measure(std::span<const double> values) {
  MeanSpread out;
  if (values.empty()) return out;
  const double n = static_cast<double>(values.size());
  for (double v : values) out.mean += v;
  out.mean /= n;
  for (double v : values) out.spread += (v - out.mean) * (v - out.mean);
  out.spread = std::sqrt(out.spread / n);
  return out;
}

ConstQuatTrack part_of(const ConstQuatTrack& track, std::size_t start, std::size_t count) {
  return {track.x.subspan(start, count), track.y.subspan(start, count), track.z.subspan(start, count),
          track.w.subspan(start, count)};
}

// Returns how far the mean is from settled: 0 but for a Karcher mean that could not be found.
double measure_joint(JointStats& out, const ConstQuatTrack& rotations, const QuatStatsParams& params) {
  if (params.space == StyleSpace::euler) {
    const auto channels = euler_channels(rotations, out.order);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const MeanSpread dof = measure(channels[axis]);
      out.euler_mean[axis] = dof.mean;
      out.euler_spread[axis] = dof.spread;
    }
    return 0;
  }
  const bool karcher = params.mean == MeanKind::karcher;
  const QuaternionMean found = karcher ? karcher_mean(rotations) : slerp_mean(rotations);
  out.mean = found.mean;
  out.spread = found.spread;
  return karcher ? found.residual : 0;
}

}  // namespace

const char* name_of(MeanKind kind) {
  return kind == MeanKind::karcher ? "karcher" : "slerp";
}
const char* name_of(StyleSpace space) {
  return space == StyleSpace::quaternion ? "quaternion" : "euler";
}

Stats quat_stats(const Motion& motion, const QuatStatsParams& params, Work& work) {
  return quat_stats(motion, encode_root(motion, work), params, work);
}

Stats quat_stats(const Motion& motion, const EncodedRoot& root, const QuatStatsParams& params, Work& work) {
  const std::size_t end = params.end == 0 ? motion.frames() : params.end;
  if (params.start >= end || end > motion.frames()) {
    throw Failure(error("no-frames", "there are no frames to measure")
                      .at_port("motion")
                      .hinting("give a motion with at least one frame in range"));
  }
  const std::size_t count = end - params.start;
  const Skeleton& skeleton = motion.skeleton();

  Stats stats;
  stats.space = name_of(params.space);
  stats.mean_kind = name_of(params.mean);
  stats.fps = motion.fps();
  stats.frames = count;
  stats.leg_length = leg_length(skeleton);
  stats.joints.resize(skeleton.joints.size());
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    stats.joints[j].joint = joint.name;
    stats.joints[j].chosen = params.joints.empty() || params.joints[j];
    if (params.space == StyleSpace::euler)
      stats.joints[j].order = euler_order_of(motion, static_cast<int>(j));
    stats.parents.push_back(joint.parent);
    stats.offsets.push_back(joint.offset);
    stats.rests.push_back(joint.rest);
  }

  const std::vector<double> rho = as_channels(root.rho);
  std::vector<double> unsettled(stats.joints.size(), 0.0);
  work.parallel(stats.joints.size(), 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      work.check();
      if (!stats.joints[j].chosen) continue;
      const ConstQuatTrack whole = j == 0 ? track_of(rho) : motion.rotation(static_cast<int>(j));
      unsettled[j] = measure_joint(stats.joints[j], part_of(whole, params.start, count), params);
    }
  });
  for (std::size_t j = 0; j < unsettled.size(); ++j) {
    if (unsettled[j] < 1e-9) continue;
    const std::string& name = stats.joints[j].joint;
    work.report(
        warning("no-clear-mean", "the rotations of " + name + " are spread so far that no mean stands out")
            .at_joint(name)
            .hinting("choose a shorter range, or leave the joint out of joints"));
  }

  // The first frame measured has no travel of its own: its entry tells how it was reached from a frame
  // outside.
  const auto channel = [&](const std::vector<double>& values, std::size_t skip) {
    return measure(std::span<const double>(values).subspan(params.start + skip, count - skip));
  };
  const std::array<MeanSpread, 4> axes{channel(root.d_x, 1), channel(root.d_z, 1), channel(root.height, 0),
                                       channel(root.d_heading, 1)};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    stats.root_mean[axis] = axes[axis].mean;
    stats.root_spread[axis] = axes[axis].spread;
  }
  return stats;
}

}  // namespace kinegraph
