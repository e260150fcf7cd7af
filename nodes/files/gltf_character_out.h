// The meshes and skins of a character in a glTF file that is being built.
#pragma once
#include <vector>

#include "nodes/files/gltf_out.h"
#include "nodes/motion/character.h"

namespace kinegraph {

// As glTF stores it: columns one after the other.
void put_matrix(std::vector<float>& out, const Affine& map);

// Positions, normals, texture coordinates and triangles of a primitive.
void add_geometry(GltfOut& out, Json& primitive, const MeshPart& part);
// A vertex's influences, the largest first, their sum 1, unused ones zero; as many sets of four as are used.
void add_weights(GltfOut& out, Json& primitive, const MeshPart& part);

// Morph targets that a part has beyond those of its source mesh.
void add_new_morphs(GltfOut& out, const Character& character);
// Takes the weights of skinned parts out, before what is left is carried over: repair_skins writes them anew.
void drop_source_weights(GltfOut& out, const Character& character);
// Weights normalised, unused joints zero, skinned meshes in nodes of the scene. Returns the node of each
// part.
std::vector<int> repair_skins(GltfOut& out, const Character& character);

// The source's meshes become one a part, without weights; parts that the program made get an empty one.
void keep_meshes_of_parts(GltfOut& out, const Character& character);
// Fills those meshes with what the source doesn't give, and hangs them on new nodes: skinned ones into the
// scene, rigid ones under their joint. Adds the skins. Returns the node of each part.
std::vector<int> add_parts(GltfOut& out, const Character& character, const std::vector<int>& node_of_joint);

}  // namespace kinegraph
