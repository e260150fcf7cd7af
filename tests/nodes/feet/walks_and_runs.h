// Every walk and run that there is to test feet on, drifts, and measures that share no code with the nodes.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nodes/files/motion_file.h"
#include "nodes/gait/gait.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {

inline Motion gait_motion(const std::string& gait) {
  GaitParams params;
  params.gait = gait;
  Alone work;
  return make_gait(params, work);
}

// A file below the mocap folder; BVH converted from CMU begins with a T-pose that isn't part of the motion.
inline Motion clip(const std::string& path) {
  ReadOptions options;
  options.drop_rest_frame = path.ends_with(".bvh") && path.find("_tmoco") == path.npos;
  PlainFiles files;
  Alone work;
  return *read_motion_file(mocap(path), options, files, work).motion();
}

inline std::vector<std::string> gaits() {
  return {"walk", "run", "sneak", "hobble", "strut", "stealthy", "jaunty", "stride"};
}
// The walks and runs of the README beside the files.
inline std::vector<std::string> walks_and_runs() {
  return {"cmu/asfamc/02_01.amc",
          "cmu/asfamc/07_05.amc",
          "cmu/asfamc/09_06.amc",
          "cmu/asfamc/141_01.amc",
          "cmu/asfamc/16_15.amc",
          "cmu/asfamc/16_31.amc",
          "cmu/asfamc/16_45.amc",
          "cmu/asfamc/17_03.amc",
          "cmu/asfamc/35_01.amc",
          "cmu/bvh/02_01.bvh",
          "cmu/bvh/02_03.bvh",
          "cmu/bvh/07_01.bvh",
          "cmu/bvh/07_05.bvh",
          "cmu/bvh/08_01.bvh",
          "cmu/bvh/08_05.bvh",
          "cmu/bvh/08_07.bvh",
          "cmu/bvh/09_06.bvh",
          "cmu/bvh/104_HappyStartWalk_3.bvh",
          "cmu/bvh_daz/141_01.bvh",
          "cmu/bvh_max/131_01.bvh",
          "cmu/bvh_other/007_01_iclone.bvh",
          "cmu/bvh_other/02_01_tmoco.bvh"};
}

inline bool runs(const std::string& clip) {
  for (const char* run : {"09_06", "141_01", "16_45", "02_03"})
    if (clip.find(run) != clip.npos) return true;
  return false;
}

// The motion on a ground that slides under it, m/s; along the path and to its left.
inline Motion drifted(Motion motion, double along, double across) {
  const Vec3Track root = motion.translation(0);
  Vec3 path = root[motion.frames() - 1] - root[0];
  path.y = 0;
  path = normalized(path);
  const Vec3 drift = along * path + across * Vec3{path.z, 0, -path.x};
  for (std::size_t t = 0; t < motion.frames(); ++t)
    root.set(t, root[t] + (static_cast<double>(t) / motion.fps()) * drift);
  return motion;
}

// Second-order Butterworth, forwards and backwards, 15 Hz.
inline std::vector<double> low_passed(const std::vector<double>& x, double fps) {
  const double w = std::tan(3.14159265358979 * 15 / fps), n = 1 / (1 + std::sqrt(2.0) * w + w * w);
  const double b = w * w * n, a1 = 2 * (w * w - 1) * n, a2 = (1 - std::sqrt(2.0) * w + w * w) * n;
  const std::size_t pad = std::min<std::size_t>(60, x.size() - 1);
  std::vector<double> e;
  for (std::size_t i = pad; i > 0; --i) e.push_back(2 * x[0] - x[i]);
  e.insert(e.end(), x.begin(), x.end());
  for (std::size_t i = 1; i <= pad; ++i) e.push_back(2 * x.back() - x[x.size() - 1 - i]);
  for (int pass = 0; pass < 2; ++pass) {
    double x1 = e[0], x2 = e[0], y1 = e[0], y2 = e[0];
    for (double& v : e) {
      const double y = b * (v + 2 * x1 + x2) - a1 * y1 - a2 * y2;
      x2 = x1;
      x1 = v;
      y2 = y1;
      y1 = y;
      v = y;
    }
    std::reverse(e.begin(), e.end());
  }
  return {e.begin() + static_cast<std::ptrdiff_t>(pad),
          e.begin() + static_cast<std::ptrdiff_t>(pad + x.size())};
}
inline double largest_acceleration(const WorldMotion& world, int joint, double fps) {
  std::vector<double> axes[3];
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t t = 0; t < world.frames(); ++t) values.push_back(world.position(joint)[t][axis]);
    axes[axis] = low_passed(values, fps);
  }
  double largest = 0;
  for (std::size_t t = 1; t + 1 < world.frames(); ++t) {
    Vec3 a;
    for (int axis = 0; axis < 3; ++axis) a[axis] = axes[axis][t - 1] - 2 * axes[axis][t] + axes[axis][t + 1];
    largest = std::max(largest, norm(a) * fps * fps);
  }
  return largest;
}

}  // namespace kinegraph
