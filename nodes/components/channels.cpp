#include "nodes/components/channels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/components/decomposed_pose.h"
#include "nodes/components/stabilised_points.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

// Angles in steps of less than half a turn from one to the next.
double unwrapped(double angle, double before) {
  return angle - 2 * pi * std::round((angle - before) / (2 * pi));
}

void put(Rows& rows, std::size_t row, std::size_t t, Vec3 v) {
  rows(row, t) = v.x;
  rows(row + 1, t) = v.y;
  rows(row + 2, t) = v.z;
}

Vec3 angles_near(Quat q, const std::string& order, const double* near) {
  const auto angles = to_euler(q, order, near);
  return {unwrapped(angles[0], near[0]), unwrapped(angles[1], near[1]), unwrapped(angles[2], near[2])};
}

}  // namespace

Rows channels_of(const ChannelSpace& space, const Motion& motion, const std::vector<double>& before,
                 Work& work) {
  const DecomposedPose prepared(space, motion, work);
  const std::size_t frames = motion.frames(), per = space.per_label();
  for (std::size_t i = 0; i < space.joints.size(); ++i)
    if (prepared.joint(space.joints[i]) < 0)
      throw Failure(error("joint-missing", "the motion has no joint '" + space.labels[i] + "'")
                        .at_joint(space.labels[i])
                        .hinting("bring it to the components' skeleton with Retarget"));
  Rows out(space.channels(), frames);
  if (space.representation == Representation::points) {
    RootedPoses poses;
    for (std::size_t begin = 0; begin < frames; begin += frames_at_a_time) {
      work.check();
      rooted_poses(prepared, begin, std::min(frames, begin + frames_at_a_time), poses);
      for (std::size_t i = 0; i < space.joints.size(); ++i) {
        const ConstVec3Track track = std::as_const(poses.positions)[space.joints[i]];
        std::copy(track.x.begin(), track.x.end(), out.row(i * per) + begin);
        std::copy(track.y.begin(), track.y.end(), out.row(i * per + 1) + begin);
        std::copy(track.z.begin(), track.z.end(), out.row(i * per + 2) + begin);
      }
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
        put(out, row, t, angles_near(q, space.orders[i], near));
      }
    }
  }
  return out;
}

std::vector<double> first_angles_of(const ChannelSpace& space, const Motion& motion,
                                    const std::vector<double>& before, Work& work) {
  const DecomposedPose prepared(space, motion, work);
  std::vector<double> out;
  for (std::size_t i = 0; i < space.joints.size(); ++i) {
    const Vec3 angles = angles_near(prepared.local(space.joints[i], 0), space.orders[i], &before[3 * i]);
    out.insert(out.end(), {angles.x, angles.y, angles.z});
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

Rows channels_on_path(const ChannelSpace& space, const Points& points, const Motion& base, Work& work) {
  const auto labels = labels_of(space.labels, points);
  check_whole(points, labels);
  const DecomposedPose prepared(space, base, work);
  const double scale = base.skeleton().above_scale;
  Rows out(space.channels(), points.frames);
  for (std::size_t t = 0; t < points.frames; ++t) {
    if (t % 256 == 0) work.check();
    const Vec3 place = prepared.root_place(t);
    const Quat back = inverse(prepared.root_facing(t));
    for (std::size_t i = 0; i < labels.size(); ++i)
      put(out, 3 * i, t, rotate(back, points.track(labels[i])[t] - place) / scale);
  }
  return out;
}

}  // namespace kinegraph
