// FBX as a motion and a character: a skeleton, its animation, and skinned meshes without their materials.
#pragma once
#include <string_view>

#include "nodes/files/gltf_read.h"

namespace kinegraph {

// The file becomes the glTF that it would be, in metres and Y up, and is read as one: joints, clips and skins
// are chosen as there. Bones rest where they were bound; a clip starts at its first key and has a sample a
// frame. Unit and axes are what the file's settings say, or the options. Reports "sparse-keys" where Assimp's
// straight lines between keys stand for curves, and "clips" where there are several. Throws Failure
// ("bad-fbx", "no-fbx", and what glTF throws).
// Assimp works in single precision with the C library's functions: near half turns that costs some 1e-4 of
// the height, and last bits may differ between CPUs.
GltfContents read_fbx(std::string_view bytes, const ReadOptions& options, FileAccess& files, Work& work);

}  // namespace kinegraph
