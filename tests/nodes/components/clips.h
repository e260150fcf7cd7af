// Clips for tests of components.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "nodes/components/ica.h"
#include "nodes/files/motion_file.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {

using Clips = std::vector<std::shared_ptr<const Motion>>;

inline std::shared_ptr<const Motion> shared(Motion motion) {
  return std::make_shared<const Motion>(std::move(motion));
}
inline std::shared_ptr<const Motion> real_clip(const std::string& path) {
  PlainFiles files;
  Alone work;
  const MotionFile file = read_motion_file(mocap(path), {}, files, work);
  return shared(*file.motion());
}
inline Components analysed(const Clips& clips, Representation representation, int components, Work& work,
                           bool rotate = true) {
  IcaParams params;
  params.components = components;
  params.rotate = rotate;
  if (components > 20) {  // for tests of what doesn't depend on how independent they are
    params.starts = 1;
    params.fast_ica.iterations = 5;
  }
  const std::vector<bool> all(clips.front()->joints(), true);
  return components_of_motions(space_of_motions(representation, clips, all, true, {}, work), clips, params,
                               work);
}

}  // namespace kinegraph
