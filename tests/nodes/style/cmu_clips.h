// The CMU clips of tests, read as the README of the motion capture folder says.
#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "graph/work.h"
#include "nodes/files/bvh_read.h"
#include "nodes/motion/motion.h"
#include "tests/mocap.h"

namespace kinegraph {

// A cgspeed conversion: frame 0 is a T-pose that the converter put there.
inline Motion cmu_clip(const std::string& name) {
  std::ifstream file(mocap("cmu/bvh/" + name + ".bvh"), std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  ReadOptions options;
  options.drop_rest_frame = true;
  Alone work;
  return read_bvh(text, options, work);
}

inline std::vector<std::pair<std::string, Motion>> all_cmu_clips() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(mocap("cmu/bvh"))) {
    if (entry.path().extension() == ".bvh") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  std::vector<std::pair<std::string, Motion>> clips;
  for (const std::string& name : names) clips.emplace_back(name, cmu_clip(name));
  return clips;
}

}  // namespace kinegraph
