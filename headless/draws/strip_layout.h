// Where a strip puts each moment of a motion.
#pragma once
#include <vector>

#include "headless/draws/camera.h"
#include "headless/draws/skeleton_figure.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct StripLayout {
  std::vector<std::size_t> frames;  // the moments
  std::vector<Vec3> followed;       // at every frame: the world point that is put at `across`; on the floor
  std::vector<double> across;       // at every frame: x on the page
  bool to_scale = false;            // distances between moments are those of the path
  bool travels = false;
  double floor = 0;  // world height, m
};

// The body's way over the floor, smoothed so that a figure sways about its place and doesn't shake it.
std::vector<Vec3> smoothed_path(const Motion& motion, const WorldMotion& world, int body);

// The horizontal direction to look from.
struct View {
  Vec3 from;
  bool travels = false;
};
View best_view(const Motion& motion, const WorldMotion& world, const Figure& figure);

// Lays `count` moments between the page's x0 and x1 (centres of the first and the last figure).
StripLayout place_moments(const Motion& motion, const WorldMotion& world, int body, const Camera& camera,
                          bool travels, int count, double x0, double x1, double least_gap);

}  // namespace kinegraph
