// The clips that the cartoon nodes are judged on: a walk, a run, a kick, a dance and boxing.
#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "nodes/files/motion_file.h"
#include "nodes/motion/motion.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {

inline constexpr const char* cartoon_clips[] = {"cmu/bvh/08_01.bvh", "cmu/bvh/09_06.bvh", "m21/kick.bvh",
                                                "cmu/bvh/05_03.bvh", "cmu/asfamc/17_10.amc"};

// At most `frames` of a clip; of CMU's BVH files without the T-pose that a converter put before them.
inline Motion cartoon_clip(const std::string& name, std::int64_t frames = 400) {
  ReadOptions options;
  options.drop_rest_frame = name.starts_with("cmu/bvh");
  PlainFiles files;
  Alone work;
  MotionFile file = read_motion_file(mocap(name), options, files, work);
  const auto have = static_cast<std::int64_t>(file.motion()->frames());
  if (have <= frames) return *file.motion();
  const std::int64_t first = options.drop_rest_frame ? 1 : 0;
  options.range = {first, std::min(frames + first, have)};
  return *read_motion_file(mocap(name), options, files, work).motion();
}

// Every clip of mocap: BVH and AMC, the odd ones that load, and animated glTF.
inline std::vector<std::string> every_clip() {
  namespace fs = std::filesystem;
  std::vector<std::string> clips;
  for (const auto& entry : fs::recursive_directory_iterator(mocap())) {
    const std::string name = fs::relative(entry.path(), mocap()).generic_string();
    const std::string ending = entry.path().extension().string();
    if ((ending == ".bvh" || ending == ".amc" || ending == ".glb" || ending == ".gltf") &&
        !name.starts_with("odd/derived/"))
      clips.push_back(name);
  }
  std::sort(clips.begin(), clips.end());
  return clips;
}

// Whole, as it loads, but of CMU's BVH files without the T-pose before them. Files without a motion of at
// least two frames give null.
inline std::shared_ptr<const Motion> whole_clip(const std::string& name) {
  ReadOptions options;
  options.drop_rest_frame = name.starts_with("cmu/bvh/");
  PlainFiles files;
  Alone work;
  MotionFile file = read_motion_file(mocap(name), options, files, work);
  if (!file.motion() || file.motion()->frames() < 2) return nullptr;
  return std::make_shared<Motion>(*file.motion());
}

}  // namespace kinegraph
