// A motion, a character, or a character with its motion, as glTF 2.0.
#pragma once
#include <string>

#include "graph/work.h"
#include "nodes/files/gltf_out.h"
#include "nodes/files/write_options.h"
#include "nodes/motion/character.h"

namespace kinegraph {

// Either may be null, not both. A character that came from a file and wasn't bound anew keeps that file's
// nodes, meshes, skins, materials and images as they were, bytes included; only its clips give way to the
// motion. Else nodes, skins and weights are written from the values, in metres. Rotations become channels,
// and translations those of the root and of joints whose place varies. Joints without a partner stay at rest
// ("no-partner"). `options.repair`: weights are normalised, skinned meshes stand at the scene's root, and
// bufferViews get their targets. Throws Failure ("no-common-joint", "stretch").
GltfOut gltf_of(const Motion* motion, const Character* character, const WriteOptions& options, Work& work);

}  // namespace kinegraph
