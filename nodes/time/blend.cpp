#include "nodes/time/blend.h"

#include <fmt/format.h>

#include "graph/diagnostic.h"
#include "nodes/node_params.h"

namespace kinegraph {

Motion blended(const Motion& motion, const Motion& other, const std::vector<int>& partner,
               const std::vector<bool>& joints, const std::vector<double>& weights) {
  std::size_t end = motion.frames();
  while (end > 0 && weights[end - 1] == 0) --end;
  if (other.frames() < end) {
    throw Failure(
        error("too-short", fmt::format("other has {} frames; the range to be blended ends at frame {}",
                                       other.frames(), end))
            .at_port("other")
            .hinting("warp it onto motion's time with TimeWarp, or give a shorter range"));
  }
  const Skeleton& skeleton = motion.skeleton();
  const Skeleton& theirs = other.skeleton();
  // Where the fixed parents differ, root joints meet in world.
  bool same_above = skeleton.above == theirs.above && skeleton.above_offset == theirs.above_offset &&
                    skeleton.above_scale == theirs.above_scale;
  bool root_moves = partner[0] >= 0 && joints[0] && (motion.translates(0) || other.translates(partner[0]));
  Motion changed = root_moves ? motion.with_translation(0) : motion;
  Quat back = inverse(skeleton.above);
  std::vector<bool> blends(joints.size());
  for (int j = 0; j < motion.joints(); ++j) {
    if (!joints[j] || partner[j] < 0) continue;
    blends[j] = true;
    auto from = other.rotation(partner[j]);
    auto to = changed.rotation(j);
    for (std::size_t t = 0; t < end; ++t)
      to.set(t, j == 0 && !same_above ? back * (theirs.above * from[t]) : from[t]);
  }
  if (root_moves) {
    auto place = changed.translation(0);
    for (std::size_t t = 0; t < end; ++t) {
      Vec3 p = other.local_offset(partner[0], t);
      if (!same_above) {
        Vec3 world = theirs.above_offset + rotate(theirs.above, theirs.above_scale * p);
        p = rotate(back, world - skeleton.above_offset) / skeleton.above_scale;
      }
      place.set(t, p);
    }
  }
  return blended_change(motion, changed, blends, weights);
}

}  // namespace kinegraph
