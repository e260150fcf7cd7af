#include "nodes/time/trim.h"

#include <algorithm>

namespace kinegraph {

Motion trimmed(const Motion& motion, Frames range) {
  Motion result = motion.empty_like(range.end - range.start);
  auto copy = [&](std::span<const double> from, std::span<double> to) {
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(range.start), to.size(), to.begin());
  };
  for (int j = 0; j < motion.joints(); ++j) {
    auto from = motion.rotation(j);
    auto to = result.rotation(j);
    copy(from.x, to.x);
    copy(from.y, to.y);
    copy(from.z, to.z);
    copy(from.w, to.w);
    if (!motion.translates(j)) continue;
    auto place = motion.translation(j);
    auto kept = result.translation(j);
    copy(place.x, kept.x);
    copy(place.y, kept.y);
    copy(place.z, kept.z);
  }
  const SourceFacts& source = motion.source();
  if (source.read && source.read_frames == motion.frames()) {
    auto facts = std::make_shared<SourceFacts>(source);
    facts->first_read += range.start;
    facts->read_frames = result.frames();
    result.set_source(std::move(facts));
  }
  return result;
}

}  // namespace kinegraph
