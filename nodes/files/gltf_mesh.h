// Meshes and skins of a glTF file.
#pragma once
#include "nodes/files/gltf_file.h"
#include "nodes/files/gltf_nodes.h"
#include "nodes/motion/character.h"

namespace kinegraph {

// All primitives of triangles (strips and fans taken apart), one part each, in the order of nodes. Nothing
// else of the file is read, but all of it is carried in Character::source. Throws Failure ("bad-gltf").
Character gltf_character(const GltfFile& file, const GltfNodes& nodes, double metres);

}  // namespace kinegraph
