#include "nodes/files/stretch.h"

#include <fmt/format.h>

#include <algorithm>

namespace kinegraph {

Motion without_stretch(const Motion& motion, std::string_view stretch, Work& work) {
  if (stretch == "keep") return motion;
  std::vector<bool> translates(static_cast<std::size_t>(motion.joints()), false);
  if (motion.joints() > 0) translates[0] = motion.translates(0);
  double farthest = 0;
  std::string farthest_joint;
  for (int j = 1; j < motion.joints(); ++j) {
    if (!motion.translates(j)) continue;
    const Joint& joint = motion.skeleton().joints[j];
    const double slack = std::max(1e-9, 1e-6 * norm(joint.offset));
    auto track = motion.translation(j);
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      if (t % 4096 == 0) work.check();
      const double apart = norm(track[t] - joint.offset);
      if (apart <= slack) continue;
      if (stretch == "error")
        throw Failure(
            error("stretch", fmt::format("{} lies {:.3g} m from its rest offset", joint.name, apart))
                .hinting("set stretch to keep or drop")
                .at_param("stretch")
                .at_joint(joint.name)
                .at_frame(static_cast<std::int64_t>(t)));
      if (apart > farthest) {
        farthest = apart;
        farthest_joint = joint.name;
      }
    }
  }
  if (farthest > 0)
    work.report(warning("stretch-dropped",
                        fmt::format("joints are put back to their rest offsets, by up to {:.3g} m", farthest))
                    .at_joint(farthest_joint));
  Motion rigid(motion.shared_skeleton(), motion.shared_source(), motion.fps(), motion.frames(), translates);
  for (int j = 0; j < motion.joints(); ++j) {
    work.check();
    auto from = motion.rotation(j);
    auto to = rigid.rotation(j);
    std::copy(from.x.begin(), from.x.end(), to.x.begin());
    std::copy(from.y.begin(), from.y.end(), to.y.begin());
    std::copy(from.z.begin(), from.z.end(), to.z.begin());
    std::copy(from.w.begin(), from.w.end(), to.w.begin());
    if (!translates[static_cast<std::size_t>(j)]) continue;
    auto place = motion.translation(j);
    auto placed = rigid.translation(j);
    std::copy(place.x.begin(), place.x.end(), placed.x.begin());
    std::copy(place.y.begin(), place.y.end(), placed.y.begin());
    std::copy(place.z.begin(), place.z.end(), placed.z.begin());
  }
  return rigid;
}

}  // namespace kinegraph
