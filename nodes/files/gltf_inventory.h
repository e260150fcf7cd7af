// What a glTF file holds beside the one clip that is read: all its clips, skins and meshes, and what is wrong
// with them for other programs.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/compute.h"

namespace kinegraph {

struct GltfInventory {
  struct Clip {
    std::string name;
    std::size_t channels = 0, keys = 0;  // keys of the longest channel
    double seconds = 0;                  // to the last key
    std::string interpolation;           // "LINEAR", "STEP, CUBICSPLINE"
  };
  struct Skin {
    std::string name;
    std::size_t joints = 0;
  };
  struct Mesh {
    std::string name;
    std::size_t primitives = 0, vertices = 0, triangles = 0, morphs = 0;
    bool skinned = false;
  };
  std::vector<Clip> clips;
  std::vector<Skin> skins;
  std::vector<Mesh> meshes;
  std::size_t materials = 0, textures = 0;
  // Vertices whose weights don't sum to 1 within what Khronos' validator allows (2e-7 a weight), and
  // the largest miss; skinned meshes on nodes below others, which readers must ignore. Export's `repair`
  // mends both.
  std::size_t uneven_vertices = 0;
  double uneven_most = 0;
  std::vector<std::string> skinned_below;
};
// Throws Failure as reading does.
GltfInventory gltf_inventory(std::string_view bytes, const std::string& path, FileAccess& files);

}  // namespace kinegraph
