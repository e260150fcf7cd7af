// A character's skin at one moment, ready to be drawn: its vertices where a motion's pose puts them.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/motion/character.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct PosedMesh {
  std::vector<float> positions;  // x y z a vertex, world metres
  std::vector<float> normals;    // x y z a vertex, unit
  std::vector<std::uint32_t> triangles;
};

// Vertices of all parts in the pose of a frame; with no motion in the skeleton's rest pose. Null where
// nothing can be posed (no joint in common).
std::shared_ptr<const PosedMesh> posed_mesh(const Character& character, const Motion* motion,
                                            std::size_t frame);

}  // namespace kinegraph
