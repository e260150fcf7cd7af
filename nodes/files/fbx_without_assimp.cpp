#include "nodes/files/fbx_scene.h"

namespace kinegraph {

FbxScene fbx_scene(std::string_view, Work&) {
  throw Failure(
      error("no-fbx", "this Kinegraph was built without Assimp, which reads FBX for it")
          .hinting("install libassimp-dev and build again, or convert the file to GLB first (`assimp "
                   "export IN.fbx OUT.glb`, or Blender)"));
}

}  // namespace kinegraph
