// glTF 2.0 as a motion and a character.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "graph/compute.h"
#include "graph/work.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/read_options.h"
#include "nodes/motion/character.h"

namespace kinegraph {

struct GltfContents {
  Motion motion;
  std::shared_ptr<const Character> character;  // null: the file has no triangles
  std::vector<std::string> companions;
};
// Of a file that another format was turned into: what the motion remembers of that.
struct GltfOrigin {
  std::string format = "gltf";
  LengthUnit unit{0, ""};  // 0: the option's, else metres
  UpAxis up = UpAxis::y;
  double rate = 0;  // frames per second on which all keys lie; 0 = found
};
// Throws Failure ("bad-gltf", "truncated", "unknown-clip", "bad-range").
GltfContents read_gltf(std::string_view bytes, const std::string& path, const ReadOptions& options,
                       FileAccess& files, Work& work, const GltfOrigin& origin = {});

}  // namespace kinegraph
