#include "nodes/motion/kinematics.h"

namespace kinegraph {

namespace {

// Seven series a joint: x, y, z of its position, x, y, z, w of its orientation.
constexpr std::size_t series_a_joint = 7;

// A whole joint's series at once, so that every series is read and written from end to end.
struct QuatSeries {
  const double *x, *y, *z, *w;
};

void turn_all(QuatSeries a, QuatSeries b, double* __restrict x, double* __restrict y, double* __restrict z,
              double* __restrict w, std::size_t begin, std::size_t end) {
  for (std::size_t t = begin; t < end; ++t) {
    Quat q = Quat{a.x[t], a.y[t], a.z[t], a.w[t]} * Quat{b.x[t], b.y[t], b.z[t], b.w[t]};
    x[t] = q.x;
    y[t] = q.y;
    z[t] = q.z;
    w[t] = q.w;
  }
}

}  // namespace

WorldMotion::WorldMotion(int joints, std::size_t frames, double scale)
    : joints_(joints),
      frames_(frames),
      scale_(scale),
      data_(series_a_joint * static_cast<std::size_t>(joints) * frames) {}

Vec3Track WorldMotion::position(int joint) {
  double* at = data_.data() + series_a_joint * frames_ * static_cast<std::size_t>(joint);
  return {{at, frames_}, {at + frames_, frames_}, {at + 2 * frames_, frames_}};
}
ConstVec3Track WorldMotion::position(int joint) const {
  const double* at = data_.data() + series_a_joint * frames_ * static_cast<std::size_t>(joint);
  return {{at, frames_}, {at + frames_, frames_}, {at + 2 * frames_, frames_}};
}
QuatTrack WorldMotion::orientation(int joint) {
  double* at = data_.data() + (series_a_joint * static_cast<std::size_t>(joint) + 3) * frames_;
  return {{at, frames_}, {at + frames_, frames_}, {at + 2 * frames_, frames_}, {at + 3 * frames_, frames_}};
}
ConstQuatTrack WorldMotion::orientation(int joint) const {
  const double* at = data_.data() + (series_a_joint * static_cast<std::size_t>(joint) + 3) * frames_;
  return {{at, frames_}, {at + frames_, frames_}, {at + 2 * frames_, frames_}, {at + 3 * frames_, frames_}};
}

namespace {

void place_joint(const Motion& motion, int joint, WorldMotion& world, std::size_t begin, std::size_t end) {
  const Skeleton& skeleton = motion.skeleton();
  int parent = skeleton.joints[joint].parent;
  auto local = motion.rotation(joint);
  auto orientation = world.orientation(joint);
  auto position = world.position(joint);
  double scale = skeleton.above_scale;
  if (parent < 0) {
    for (std::size_t t = begin; t < end; ++t) {
      orientation.set(t, skeleton.above * local[t]);
      position.set(t, skeleton.above_offset + rotate(skeleton.above, scale * motion.local_offset(joint, t)));
    }
    return;
  }
  auto above = world.orientation(parent);
  auto from = world.position(parent);
  turn_all({above.x.data(), above.y.data(), above.z.data(), above.w.data()},
           {local.x.data(), local.y.data(), local.z.data(), local.w.data()}, orientation.x.data(),
           orientation.y.data(), orientation.z.data(), orientation.w.data(), begin, end);
  if (motion.translates(joint)) {
    auto offset = motion.translation(joint);
    for (std::size_t t = begin; t < end; ++t) position.set(t, from[t] + rotate(above[t], scale * offset[t]));
  } else {
    Vec3 offset = scale * skeleton.joints[joint].offset;
    for (std::size_t t = begin; t < end; ++t) position.set(t, from[t] + rotate(above[t], offset));
  }
}

constexpr std::size_t frames_between_checks = 4096;
constexpr std::size_t large = std::size_t{16} << 20;  // bytes; beyond it memory is announced

}  // namespace

WorldMotion world_motion(const Motion& motion, Work& work) {
  std::size_t bytes =
      sizeof(double) * series_a_joint * motion.frames() * static_cast<std::size_t>(motion.joints());
  auto reserved = bytes > large ? work.reserve(bytes) : nullptr;
  WorldMotion world(motion.joints(), motion.frames(), motion.skeleton().above_scale);
  world.hold(std::move(reserved));
  work.parallel(motion.frames(), frames_between_checks, [&](std::size_t begin, std::size_t end) {
    for (std::size_t from = begin; from < end; from += frames_between_checks) {
      std::size_t to = from + frames_between_checks < end ? from + frames_between_checks : end;
      work.check();
      for (int j = 0; j < motion.joints(); ++j) place_joint(motion, j, world, from, to);
    }
  });
  return world;
}

WorldMotion world_motion(const Motion& motion) {
  Alone alone;
  return world_motion(motion, alone);
}

Vec3 point_at(const WorldMotion& world, int joint, Vec3 local, std::size_t frame) {
  return world.position(joint)[frame] + rotate(world.orientation(joint)[frame], world.scale() * local);
}

Pose pose_at(const Motion& motion, std::size_t frame) {
  const Skeleton& skeleton = motion.skeleton();
  Pose pose;
  pose.positions.resize(skeleton.joints.size());
  pose.orientations.resize(skeleton.joints.size());
  for (int j = 0; j < skeleton.size(); ++j) {
    int parent = skeleton.joints[j].parent;
    Quat above = parent < 0 ? skeleton.above : pose.orientations[parent];
    Vec3 from = parent < 0 ? skeleton.above_offset : pose.positions[parent];
    pose.orientations[j] = above * motion.rotation(j)[frame];
    pose.positions[j] = from + rotate(above, skeleton.above_scale * motion.local_offset(j, frame));
  }
  return pose;
}

}  // namespace kinegraph
