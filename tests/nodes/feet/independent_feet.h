// Toes, heels and the rule that DetectContacts is held to, sharing nothing with the nodes but the motion
// itself: which joints are toes and heels is written down here, and where they are is found by plain forward
// kinematics.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"
#include "tests/main_job/independent_measures.h"

namespace kinegraph::independent {

using Flags = std::vector<bool>;
using Path = std::vector<Vec3>;

// The joints of one foot, by the names that the clips' skeletons use; a foot without a toe joint ends in its
// End Site.
struct Foot {
  const char *heel, *toe;
};
inline const std::array<std::array<Foot, 2>, 6> feet_of_skeletons{{
    {{{"LeftFoot", "LeftToeBase"}, {"RightFoot", "RightToeBase"}}},  // cgspeed, Gait, m21, Xia, ACCAD
    {{{"lfoot", "ltoes"}, {"rfoot", "rtoes"}}},                      // CMU's own
    {{{"LeftAnkle", "LeftToe"}, {"RightAnkle", "RightToe"}}},        // cgspeed for 3dsMax
    {{{"CC_Base_L_Foot", "CC_Base_L_ToeBase"}, {"CC_Base_R_Foot", "CC_Base_R_ToeBase"}}},  // iClone
    {{{"Foot_L", "Toes_L"}, {"Foot_R", "Toes_R"}}},                                        // Bandai Namco
    {{{"lFoot", nullptr}, {"rFoot", nullptr}}},                                            // cgspeed for DAZ
}};

// Heel and toe of the left or right foot, world, metres.
inline std::array<Path, 2> heel_and_toe(const Motion& motion, bool left) {
  const Skeleton& skeleton = motion.skeleton();
  const auto positions = positions_of(motion);
  for (const auto& names : feet_of_skeletons) {
    const Foot& foot = names[left ? 0 : 1];
    const int heel = foot.heel ? skeleton.find(foot.heel) : -1;
    if (heel < 0) continue;
    if (foot.toe) return {positions[heel], positions[skeleton.find(foot.toe)]};
    // An End Site rides on its joint: placed by the joint's rotations all the way up.
    for (const EndSite& end : skeleton.ends) {
      if (end.joint != heel) continue;
      Path toe;
      for (std::size_t t = 0; t < motion.frames(); ++t) {
        Vec3 offset = end.offset;
        for (int joint = heel; joint >= 0; joint = skeleton.joints[joint].parent)
          offset = rotate(motion.rotation(joint)[t], offset);
        toe.push_back(positions[heel][t] + rotate(skeleton.above, offset));
      }
      return {positions[heel], toe};
    }
  }
  throw std::runtime_error("feet of this skeleton aren't written down here");
}

// Under 0.25 m/s over ±4 frames at 120 fps and under the 10th percentile of its height + 4 cm, in runs of
// over `least` seconds.
inline Flags rests(const Path& path, double fps, double least) {
  const auto side = static_cast<std::size_t>(std::max(1L, std::lround(4 * fps / 120)));
  std::vector<double> heights;
  for (const Vec3& p : path) heights.push_back(p.y);
  std::sort(heights.begin(), heights.end());
  const double ceiling = heights[(heights.size() - 1) / 10] + 0.04;
  Flags flags(path.size());
  for (std::size_t t = 0; t < flags.size(); ++t) {
    const std::size_t a = t < side ? 0 : t - side, b = std::min(flags.size() - 1, t + side);
    const Vec3 way = path[b] - path[a];
    const double speed = std::sqrt(dot(way, way)) * fps / static_cast<double>(b - a);
    flags[t] = speed < 0.25 && path[t].y < ceiling;
  }
  for (const kinegraph::Run& run : runs_of(flags))
    for (std::size_t t = run.start; t < run.end; ++t)
      if (static_cast<double>(run.end - run.start) <= least * fps) flags[t] = false;
  return flags;
}
// Toe or heel of one foot.
inline Flags rests(const Motion& motion, bool left, double least) {
  const auto [heel, toe] = heel_and_toe(motion, left);
  Flags flags = rests(heel, motion.fps(), least);
  const Flags of_toe = rests(toe, motion.fps(), least);
  for (std::size_t t = 0; t < flags.size(); ++t) flags[t] = flags[t] || of_toe[t];
  return flags;
}

}  // namespace kinegraph::independent
