// The nodes of a glTF file as a skeleton.
#pragma once
#include <memory>
#include <vector>

#include "graph/work.h"
#include "nodes/files/gltf_file.h"
#include "nodes/motion/affine.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

struct GltfNodes {
  std::vector<int> parent;                   // of each node; -1 = of the scene
  std::vector<Decomposed> local;             // matrices taken apart
  std::vector<Affine> world;                 // at rest, in the file's unit
  std::shared_ptr<const Skeleton> skeleton;  // metres
  std::vector<int> joint_of_node;            // -1: no joint
  std::vector<int> node_of_joint;            // -1: a root made up for a forest
  std::vector<double> scale_of_parent;       // of a joint: metres a unit of its translation
};

// Joints are the nodes that skins name, those between them, and what animations move above or below them;
// without skins all nodes that animations move; without either the first root. What stands above the root
// goes into Skeleton::above, with scales folded into lengths. Leaves below a joint that carry nothing are End
// Sites. Throws Failure ("bad-gltf"): a node with two parents, or below itself.
GltfNodes gltf_nodes(const GltfFile& file, double metres, Work& work);

}  // namespace kinegraph
