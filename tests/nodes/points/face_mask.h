// A mesh for markers on a face: a mask over where they rest, so that tests need no mesh of others.
#pragma once
#include <algorithm>
#include <cmath>

#include "nodes/motion/character.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// A sheet in front of the world's +Z side of the markers at frame 0, an oval round all of them, each vertex
// as deep as the markers near it; rings × spokes vertices and one in the middle, fixed on a skeleton of one
// joint. Metres.
inline Character face_mask(const Points& markers, int rings = 34, int spokes = 72) {
  Vec3 low{1e300, 1e300, 1e300}, high = -low;
  for (int i = 0; i < static_cast<int>(markers.labels.size()); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], markers.track(i)[0][axis]);
      high[axis] = std::max(high[axis], markers.track(i)[0][axis]);
    }
  const Vec3 middle = 0.5 * (low + high), reach = 0.56 * (high - low);
  const double near = 0.11 * (high.y - low.y);
  const auto depth = [&](double x, double y) {
    double sum = 0, weights = 0;
    for (int i = 0; i < static_cast<int>(markers.labels.size()); ++i) {
      const Vec3 marker = markers.track(i)[0];
      const double dx = (x - marker.x) / near, dy = (y - marker.y) / near;
      const double weight = exponential(-0.5 * (dx * dx + dy * dy)) + 1e-6;
      sum += weight * marker.z, weights += weight;
    }
    return sum / weights;
  };
  Character character;
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {{"face", -1, {}, {}}};
  character.skeleton = skeleton;
  MeshPart part;
  part.name = "mask";
  part.joint = 0;
  const auto vertex = [&](double x, double y) {
    for (double value : {x, y, depth(x, y)}) part.positions.push_back(static_cast<float>(value));
  };
  vertex(middle.x, middle.y);
  for (int ring = 1; ring <= rings; ++ring)
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const SinCos way = sin_cos(2 * pi * spoke / spokes);
      vertex(middle.x + reach.x * ring / rings * way.cos, middle.y + reach.y * ring / rings * way.sin);
    }
  const auto at = [&](int ring, int spoke) {
    return static_cast<std::uint32_t>(ring == 0 ? 0 : 1 + (ring - 1) * spokes + spoke % spokes);
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int spoke = 0; spoke < spokes; ++spoke) {
      for (std::uint32_t corner : {at(ring, spoke), at(ring + 1, spoke), at(ring + 1, spoke + 1)})
        part.triangles.push_back(corner);
      if (ring > 0)
        for (std::uint32_t corner : {at(ring, spoke), at(ring + 1, spoke + 1), at(ring, spoke + 1)})
          part.triangles.push_back(corner);
    }
  character.parts.push_back(std::move(part));
  return character;
}

}  // namespace kinegraph
