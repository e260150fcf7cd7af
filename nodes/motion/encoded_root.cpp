#include "nodes/motion/encoded_root.h"

#include <fmt/format.h>

#include <cmath>

#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// cos of half of 180° - 5°: the length of a quaternion's part along up where the swing is that wide.
constexpr double singular_length = 0.043619387365336;

Vec3 root_position(const Motion& motion, std::size_t frame) {
  const Skeleton& skeleton = motion.skeleton();
  return skeleton.above_offset + rotate(skeleton.above, skeleton.above_scale * motion.local_offset(0, frame));
}

// R_y(angle) v
Vec3 turned_about_y(Vec3 v, SinCos angle) {
  return {angle.cos * v.x + angle.sin * v.z, v.y, angle.cos * v.z - angle.sin * v.x};
}

// The headings of frames that have none lie on a straight line between their neighbours'.
void bridge(std::vector<double>& heading, const std::vector<bool>& singular) {
  std::size_t frames = heading.size();
  for (std::size_t begin = 0; begin < frames;) {
    if (!singular[begin]) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < frames && singular[end]) ++end;
    bool before = begin > 0, after = end < frames;
    for (std::size_t t = begin; t < end; ++t) {
      if (before && after) {
        double part = static_cast<double>(t - begin + 1) / static_cast<double>(end - begin + 1);
        heading[t] = heading[begin - 1] + part * (heading[end] - heading[begin - 1]);
      } else {
        heading[t] = before ? heading[begin - 1] : after ? heading[end] : 0;
      }
    }
    begin = end;
  }
}

std::vector<double> headings(const Motion& motion, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  Quat above = skeleton.above;
  Quat from_rest = inverse(above * skeleton.joints[0].rest);
  std::size_t frames = motion.frames();
  std::vector<double> heading(frames);
  std::vector<bool> singular(frames);
  std::size_t count = 0, first = 0;
  double last = 0;
  bool started = false;
  auto local = motion.rotation(0);
  for (std::size_t t = 0; t < frames; ++t) {
    if (t % 4096 == 0) work.check();
    Quat q = above * local[t] * from_rest;
    if (std::sqrt(q.y * q.y + q.w * q.w) < singular_length) {
      singular[t] = true;
      if (count++ == 0) first = t;
      continue;
    }
    double psi = heading_of(q);
    if (started) psi += 2 * pi * std::floor((last - psi) / (2 * pi) + 0.5);
    heading[t] = last = psi;
    started = true;
  }
  if (count > 0) {
    bridge(heading, singular);
    auto told = warning(
        "heading-singular",
        fmt::format("{} frame{} from {} on: the root hangs head down, so it has no heading there; it was "
                    "taken from the frames around",
                    count, count == 1 ? "" : "s", first));
    told.joint = skeleton.joints[0].name;
    told.frame = static_cast<std::int64_t>(first);
    work.report(std::move(told));
  }
  return heading;
}

void decode(const EncodedRoot& root, const std::vector<double>& heading, Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  Quat back = inverse(skeleton.above);
  auto rotation = motion.rotation(0);
  auto translation = motion.translation(0);
  Vec3 p = root.start;
  SinCos facing{0, 1};  // of the frame before
  for (std::size_t t = 0; t < root.frames(); ++t) {
    if (t > 0) {
      Vec3 d = turned_about_y({root.d_x[t], 0, root.d_z[t]}, facing);
      p.x += d.x / root.fps;
      p.z += d.z / root.fps;
    }
    p.y = root.height[t];
    translation.set(t, rotate(back, p - skeleton.above_offset) / skeleton.above_scale);
    auto [sin, cos] = sin_cos(0.5 * heading[t]);
    rotation.set(t, back * (Quat{0, sin, 0, cos} * root.rho[t]));
    facing = {2 * sin * cos, (cos - sin) * (cos + sin)};
  }
  make_continuous(rotation.x, rotation.y, rotation.z, rotation.w);
}

}  // namespace

EncodedRoot encode_root(const Motion& motion, Work& work) {
  EncodedRoot root;
  root.fps = motion.fps();
  std::size_t frames = motion.frames();
  if (frames == 0) return root;
  root.heading = headings(motion, work);
  root.start = root_position(motion, 0);
  root.start_heading = root.heading[0];
  root.d_x.resize(frames);
  root.d_z.resize(frames);
  root.d_heading.resize(frames);
  root.height.resize(frames);
  root.rho.resize(frames);
  auto local = motion.rotation(0);
  Vec3 last = root.start;
  SinCos facing{0, 1};  // of the frame before
  for (std::size_t t = 0; t < frames; ++t) {
    if (t % 4096 == 0) work.check();
    Vec3 p = root_position(motion, t);
    root.height[t] = p.y;
    if (t > 0) {
      Vec3 d = turned_about_y(p - last, {-facing.sin, facing.cos});  // R_y(-ψ_{t-1})
      root.d_x[t] = d.x * root.fps;
      root.d_z[t] = d.z * root.fps;
      root.d_heading[t] = (root.heading[t] - root.heading[t - 1]) * root.fps;
    }
    last = p;
    auto [sin, cos] = sin_cos(0.5 * root.heading[t]);
    Quat rho = Quat{0, -sin, 0, cos} * (motion.skeleton().above * local[t]);
    root.rho[t] = t > 0 ? nearer(rho, root.rho[t - 1]) : rho;
    facing = {2 * sin * cos, (cos - sin) * (cos + sin)};
  }
  if (frames > 1) {
    root.d_x[0] = root.d_x[1];
    root.d_z[0] = root.d_z[1];
    root.d_heading[0] = root.d_heading[1];
  }
  return root;
}

void decode_root(const EncodedRoot& root, Motion& motion) {
  std::vector<double> heading(root.frames());
  for (std::size_t t = 0; t < heading.size(); ++t)
    heading[t] = t == 0 ? root.start_heading : heading[t - 1] + root.d_heading[t] / root.fps;
  decode(root, heading, motion);
}

void decode_root_keeping_heading(const EncodedRoot& root, Motion& motion) {
  decode(root, root.heading, motion);
}

}  // namespace kinegraph
