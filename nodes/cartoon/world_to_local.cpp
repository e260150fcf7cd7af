#include "nodes/cartoon/world_to_local.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/track_kernels.h"

namespace kinegraph {
namespace {

constexpr double rigid = 1e-10;  // of the height

// Where joint j stands in its parent's frame.
void local_offsets(const Skeleton& skeleton, const WorldMotion& world, int j, Vec3Track out) {
  const int parent = skeleton.joints[j].parent;
  const auto at = world.position(j);
  const double scale = 1 / skeleton.above_scale;
  if (parent < 0) {
    const Quat back = inverse(skeleton.above);
    for (std::size_t t = 0; t < world.frames(); ++t)
      out.set(t, scale * rotate(back, at[t] - skeleton.above_offset));
    return;
  }
  const auto from = world.position(parent);
  const auto frame = world.orientation(parent);
  for (std::size_t t = 0; t < world.frames(); ++t)
    out.set(t, scale * rotate(inverse(frame[t]), at[t] - from[t]));
}

}  // namespace

Motion motion_from_world(std::shared_ptr<const Skeleton> skeleton, std::shared_ptr<const SourceFacts> source,
                         double fps, std::vector<bool> translates, const WorldMotion& world, Work& work) {
  const Skeleton& tree = *skeleton;
  const std::size_t frames = world.frames();
  const double least = rigid * std::max(rest_height(tree), 1e-3);
  std::vector<double> offsets(3 * frames * tree.joints.size());
  const auto track = [&](int j) {
    double* at = offsets.data() + 3 * frames * static_cast<std::size_t>(j);
    return Vec3Track{{at, frames}, {at + frames, frames}, {at + 2 * frames, frames}};
  };
  for (int j = 0; j < tree.size(); ++j) {
    work.check();
    const Vec3Track local = track(j);
    local_offsets(tree, world, j, local);
    const Vec3 rest = tree.joints[j].offset;
    for (std::size_t t = 0; t < frames && !translates[j]; ++t) {
      const Vec3 away = local[t] - rest;
      translates[j] = dot(away, away) > least * least;
    }
  }
  Motion motion(skeleton, std::move(source), fps, frames, translates);
  for (int j = 0; j < tree.size(); ++j) {
    work.check();
    const auto orientation = world.orientation(j);
    const auto rotation = motion.rotation(j);
    const int parent = tree.joints[j].parent;
    if (parent < 0) {
      const Quat back = inverse(tree.above);
      for (std::size_t t = 0; t < frames; ++t) rotation.set(t, normalized(back * orientation[t]));
    } else {
      multiply_tracks(world.orientation(parent), true, orientation, rotation);
    }
    make_continuous(rotation.x, rotation.y, rotation.z, rotation.w);
    if (!translates[j]) continue;
    const auto from = track(j);
    const auto to = motion.translation(j);
    std::copy(from.x.begin(), from.x.end(), to.x.begin());
    std::copy(from.y.begin(), from.y.end(), to.y.begin());
    std::copy(from.z.begin(), from.z.end(), to.z.begin());
  }
  return motion;
}

}  // namespace kinegraph
