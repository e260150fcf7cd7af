// A motion of three joints whose channels a test sets by functions of the frame.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

inline std::shared_ptr<const Skeleton> three_joints() {
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {
      {"Hips", -1, {0, 1, 0}, {}}, {"Spine", 0, {0, 0.3, 0}, {}}, {"Head", 1, {0, 0.4, 0}, {}}};
  skeleton->ends = {{2, {0, 0.2, 0}, ""}};
  return skeleton;
}

struct SmallMotion {
  std::function<Vec3(double)> place = [](double) { return Vec3{0, 1, 0}; };
  std::function<Quat(double)> hips = [](double) { return Quat{}; };
  std::function<Quat(double)> spine = [](double) { return Quat{}; };
  std::function<Quat(double)> head = [](double) { return Quat{}; };

  Motion made(std::size_t frames, double fps = 120) const {
    Motion motion(three_joints(), std::make_shared<SourceFacts>(), fps, frames, {true, false, false});
    for (std::size_t t = 0; t < frames; ++t) {
      const double time = static_cast<double>(t) / fps;
      motion.translation(0).set(t, place(time));
      motion.rotation(0).set(t, hips(time));
      motion.rotation(1).set(t, spine(time));
      motion.rotation(2).set(t, head(time));
    }
    return motion;
  }
};

}  // namespace kinegraph
