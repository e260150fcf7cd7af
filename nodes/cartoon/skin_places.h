// Which sub-joints of a joint move the vertices that have room for one of them only.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

// One joint's vertices in a mesh, of which vertices at the same place count as one.
struct JointSkin {
  std::span<const Vec3> at;                     // of all vertices of the mesh, at rest
  const std::vector<std::vector<int>>& beside;  // mesh_neighbours()
  double sub_link = 0;                          // m at rest
  std::vector<int> vertices;                    // that the joint moves
  std::vector<bool> tight;                      // of those: room for one of its sub-joints only
};

// For each vertex those that share an edge of a triangle with it or with one at the same place; and the
// latter.
std::vector<std::vector<int>> mesh_neighbours(std::span<const Vec3> at,
                                              std::span<const std::uint32_t> triangles);

// `places`: of each of the vertices along the joint's link, in sub-links. A patch of tight vertices that hang
// together and lie within 2.5 sub-links gets one whole place, the middle one, since a step from each
// sub-joint to the next would crease the skin there; around it places go over to their own within 1.5
// sub-links. Tight vertices of longer patches take their nearest sub-joint.
void settle_places(const JointSkin& skin, std::vector<double>& places, Work& work);

}  // namespace kinegraph
