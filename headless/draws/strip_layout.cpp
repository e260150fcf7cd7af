#include "headless/draws/strip_layout.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/elementary.h"

namespace kinegraph {

std::vector<Vec3> smoothed_path(const Motion& motion, const WorldMotion& world, int body) {
  auto root = world.position(body);
  const std::size_t frames = motion.frames();
  // Three passes of a running mean are near a Gaussian and linear in the frames.
  const auto reach =
      static_cast<std::ptrdiff_t>(std::min(0.15 * motion.fps(), static_cast<double>(frames) / 8));
  std::vector<Vec3> path(frames), sums(frames + 1);
  for (std::size_t t = 0; t < frames; ++t) path[t] = {root.x[t], 0, root.z[t]};
  const auto last = static_cast<std::ptrdiff_t>(frames) - 1;
  for (int pass = 0; pass < 3; ++pass) {
    for (std::size_t t = 0; t < frames; ++t) sums[t + 1] = sums[t] + path[t];
    for (std::ptrdiff_t t = 0; t <= last; ++t) {
      std::ptrdiff_t near = std::min({reach, t, last - t});  // shrinks at the ends, so the path keeps them
      path[static_cast<std::size_t>(t)] =
          (sums[static_cast<std::size_t>(t + near + 1)] - sums[static_cast<std::size_t>(t - near)]) /
          static_cast<double>(2 * near + 1);
    }
  }
  return path;
}

namespace {

// The way the body faces, on the mean: across the hips, turned forward. Without legs the root's heading.
Vec3 facing(const Motion& motion, const WorldMotion& world) {
  auto legs = find_legs(motion.skeleton());
  Vec3 sum;
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    if (legs.size() == 2 && legs[0].hip >= 0 && legs[1].hip >= 0)
      sum += normalized(cross(world.position(legs[0].hip)[t] - world.position(legs[1].hip)[t], {0, 1, 0}));
    else
      sum += rotate(world.orientation(0)[t], {0, 0, 1});
  }
  sum.y = 0;
  return norm(sum) > 1e-6 ? normalized(sum) : Vec3{0, 0, 1};
}

Vec3 turned_about_y(Vec3 v, double radians) {
  auto turn = sin_cos(radians);
  return {turn.cos * v.x + turn.sin * v.z, v.y, turn.cos * v.z - turn.sin * v.x};
}

}  // namespace

View best_view(const Motion& motion, const WorldMotion& world, const Figure& figure) {
  auto path = smoothed_path(motion, world, figure.body());
  Vec3 mean;
  for (Vec3 p : path) mean += p / static_cast<double>(path.size());
  double xx = 0, xz = 0, zz = 0;
  for (Vec3 p : path) {
    Vec3 d = p - mean;
    xx += d.x * d.x;
    xz += d.x * d.z;
    zz += d.z * d.z;
  }
  // Main direction of the path: the larger axis of its scatter.
  double angle = 0.5 * arc_tangent2(2 * xz, xx - zz);
  auto axis = sin_cos(angle);
  Vec3 along{axis.cos, 0, axis.sin};
  double low = 1e300, high = -1e300;
  for (Vec3 p : path) {
    low = std::min(low, dot(along, p));
    high = std::max(high, dot(along, p));
  }
  View view;
  view.travels = high - low > 0.5 * figure.height();
  if (view.travels) {
    if (dot(along, path.back() - path.front()) < 0) along = -along;
    // From the side, a little from the front: both legs and the face of the body show.
    view.from = turned_about_y(cross(along, {0, 1, 0}), 0.33);
  } else {
    view.from = turned_about_y(facing(motion, world), 0.6);
  }
  return view;
}

StripLayout place_moments(const Motion& motion, const WorldMotion& world, int body, const Camera& camera,
                          bool travels, int count, double x0, double x1, double least_gap) {
  StripLayout layout;
  const std::size_t frames = motion.frames();
  count = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(std::max(count, 1)), frames));
  for (int i = 0; i < count; ++i)
    layout.frames.push_back(
        count == 1 ? 0
                   : static_cast<std::size_t>(std::lround(static_cast<double>(i) *
                                                          static_cast<double>(frames - 1) / (count - 1))));
  layout.travels = travels;
  layout.followed = smoothed_path(motion, world, body);

  // The floor: what the lowest joint comes down to, spikes left out.
  std::vector<double> lowest(frames, 1e300);
  for (int joint = body; joint < motion.joints();
       ++joint)  // parents come first: what is above the body is no foot
    for (std::size_t t = 0; t < frames; ++t) lowest[t] = std::min(lowest[t], world.position(joint).y[t]);
  std::nth_element(lowest.begin(), lowest.begin() + static_cast<std::ptrdiff_t>(frames / 50), lowest.end());
  layout.floor = lowest[frames / 50];
  for (Vec3& p : layout.followed) p.y = layout.floor;

  layout.across.resize(frames);
  for (std::size_t t = 0; t < frames; ++t)
    layout.across[t] = frames > 1 ? x0 + (x1 - x0) * static_cast<double>(t) / static_cast<double>(frames - 1)
                                  : (x0 + x1) / 2;
  if (travels && count > 1) {
    std::vector<double> true_place(frames);
    for (std::size_t t = 0; t < frames; ++t) true_place[t] = camera.project(layout.followed[t]).x;
    double smallest = 1e300;
    for (int i = 1; i < count; ++i)
      smallest = std::min(smallest, true_place[layout.frames[i]] - true_place[layout.frames[i - 1]]);
    double span = true_place.back() - true_place.front();
    if (smallest >= least_gap && span <= x1 - x0 + 1) {
      layout.to_scale = true;
      double shift = (x0 + x1 - span) / 2 - true_place.front();
      for (std::size_t t = 0; t < frames; ++t) layout.across[t] = true_place[t] + shift;
    }
  }
  return layout;
}

}  // namespace kinegraph
