// What a picture of points must know before it draws them: where a missing point would be, which side of the
// body a label names, from where to look.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "headless/draws/skeleton_figure.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// The points with every gap bridged: on straight lines relative to the cloud's middle, held before the first
// and after the last sample. A point that is never there has no place.
struct BridgedPoints {
  std::vector<std::vector<Vec3>> places;  // [label][frame]; empty: never there
  // Of the cloud, smoothed over a third of a second. It goes where the points that are there go, whichever
  // they are, so that one that vanishes doesn't move it.
  std::vector<Vec3> middle;
  std::size_t first = 0, last = 0;  // frames between which at least half as many as ever are there
  double height = 0, width = 0;     // of the cloud about its middle, m, the largest over time
  double lowest = 0;                // world height of the lowest point, the lowest hundredth left out
};
BridgedPoints bridged(const Points& points);

// Left and right where the labels come in pairs that differ by one L and R, l and r, or Left and Right.
std::vector<Side> sides_of(const std::vector<std::string>& labels);

// The horizontal direction to look from: at the side of a cloud that travels, else at its broad side.
struct PointsView {
  Vec3 from;
  bool travels = false;
  double travelled = 0;  // along the page, m
};
PointsView view_of(const BridgedPoints& points);

// Pairs of points that keep their distance, as markers on one limb do: each point with the two nearest of
// those. Empty for more than `most` points.
std::vector<std::pair<int, int>> steady_links(const Points& points, const BridgedPoints& bridged,
                                              std::size_t most);

}  // namespace kinegraph
