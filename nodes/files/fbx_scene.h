// An FBX file taken apart, by Assimp: nodes, clips and meshes as plain numbers, in the file's own unit and
// axes.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/affine.h"
#include "nodes/motion/character.h"

namespace kinegraph {

struct FbxScene {
  // Assimp writes an FBX node's pivots, offsets and pre-rotation as a chain of helper nodes; a node here is
  // such a chain multiplied out.
  struct Node {
    std::string name;
    int parent = -1;  // before the node itself; -1: node 0, which is the scene's root
    Affine local;     // as the file has it without a clip
  };
  // Where a node that a clip holds keys of stands at each frame.
  struct Track {
    int node = 0;
    std::vector<Affine> local;
  };
  struct Clip {
    std::string name;
    std::size_t frames = 0;
    std::vector<Track> tracks;
    bool sparse = false;  // frames without keys: what lies between them is taken as straight
  };
  struct Bone {
    int node = 0;
    Affine inverse_bind;  // from the mesh's coordinates to the node's
  };
  struct Mesh {
    int node = 0;
    MeshPart part;            // `joints` are indices into `bones`
    std::vector<Bone> bones;  // none: rigid on its node
  };
  std::vector<Node> nodes;  // parents first
  std::vector<Clip> clips;
  std::vector<Mesh> meshes;
  double rate = 0;         // frames per second; 0 = no clip
  double centimetres = 1;  // a unit of the file
  // Which of the file's axes points right, up and to the front, as 0, 1, 2 for X, Y, Z; and with which sign.
  int axes[3] = {0, 1, 2};
  int signs[3] = {1, 1, 1};
};

// Throws Failure ("bad-fbx"); "no-fbx" in a program that was built without Assimp.
FbxScene fbx_scene(std::string_view bytes, Work& work);

}  // namespace kinegraph
