// A skinned mesh on a skeleton. World metres, Y up.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/value.h"
#include "nodes/motion/affine.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The joints that a mesh may be bound to. A vertex v of weight w_k on joint k stands at
//   Σ_k w_k J_k B_k v / Σ_k w_k,   J_k: the joint's world position and orientation, B_k: inverse_bind[k].
// The sum is 1 in a sound file; where it isn't, dividing by it is what Blender and three.js do, and what
// keeps the mesh whole. A vertex of no weight at all rides on its first joint. J has no scale: scales of the
// file's nodes and its unit are folded into B.
struct Skin {
  std::string name;
  std::vector<int> joints;           // of Character::skeleton
  std::vector<Affine> inverse_bind;  // one a joint
};

// Displacements of a mesh part's vertices, added with a weight before skinning.
struct MorphTarget {
  std::string name;
  std::vector<float> positions;  // x y z a vertex, displacements in the mesh's own units
  std::vector<float> normals;    // likewise; may be empty
};

// One primitive of triangles with one material. Coordinates are the mesh's own, as in the file: skins and
// `placed` bring them to metres.
struct MeshPart {
  std::string name;
  std::vector<float> positions;          // x y z a vertex
  std::vector<float> normals;            // x y z a vertex, or empty
  std::vector<float> texcoords;          // u v a vertex, or empty: the first set
  std::vector<std::uint32_t> triangles;  // three vertices each
  // Skinned: `influences` entries a vertex, in any number of glTF's sets of four. Weight 0 = unused.
  int skin = -1;                      // -1: rigid, rides on `joint`
  int influences = 0;                 // entries a vertex
  std::vector<std::uint32_t> joints;  // vertices * influences, indices into Skin::joints
  std::vector<float> weights;         // as many
  // Rigid: the vertex stands at J placed v; `joint` -1: fixed in the world, at placed v.
  int joint = -1;
  Affine placed;
  std::vector<MorphTarget> morphs;
  // Where it stands in the source: -1 = made by the program.
  int source_mesh = -1, source_primitive = -1, source_node = -1;

  std::size_t vertices() const { return positions.size() / 3; }
  Vec3 position(std::size_t vertex) const {
    return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
  }
};

// The file that a character came from, so that what the program doesn't touch goes back out as it was: its
// JSON, its buffers with meshes, materials and textures, and files beside it (name, bytes).
struct CharacterSource {
  std::string json;
  std::vector<std::string> buffers;
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<int> node_of_joint;       // -1: none
  std::vector<double> scale_of_parent;  // a node's translation times this is the joint's offset in metres
};

// How Motion's weights of morph targets move: one series a target, contiguous.
struct MorphTrack {
  int part = 0;
  int target = 0;
  std::vector<double> weights;  // one a frame
};

class Character final : public Value {
 public:
  std::shared_ptr<const Skeleton> skeleton = std::make_shared<Skeleton>();
  std::vector<Skin> skins;
  std::vector<MeshPart> parts;
  // Of a character that moves by itself, such as MarkerMesh's: morph weights over time.
  std::vector<MorphTrack> morph_tracks;
  double morph_fps = 0;
  double unit = 1;                                // metres per unit of the file
  std::shared_ptr<const CharacterSource> source;  // null: made by the program
  // Set by whoever changes skeleton, skins or weights: they are then written anew, not passed through.
  bool rebound = false;

  std::string_view type() const override { return "Character"; }
  std::size_t bytes() const override;
  void encode(Encoder& out) const override;
  std::optional<NonFinite> non_finite() const override;
};
ValuePtr decode_character(Decoder& in);

// What brings a skinned part's vertex to the world: the weighted map of `of_joint` (one a joint of its skin).
Affine skinning_map(const MeshPart& part, std::size_t vertex, const std::vector<Affine>& of_joint);
// World position of a part's vertices, x y z each, with the skeleton as `pose` has it (of `character`'s own
// skeleton). `morph_weights`: one a target, or empty.
std::vector<Vec3> posed_vertices(const Character& character, const MeshPart& part, const Pose& pose,
                                 const std::vector<double>& morph_weights = {});
// Weights of the morph targets of each part at a frame of the character's own tracks, which stay at their
// last value; without a frame all are 0.
std::vector<std::vector<double>> morph_weights_at(const Character& character,
                                                  std::optional<std::size_t> frame);
// The skeleton's rest pose as a Pose.
Pose rest_pose_of(const Skeleton& skeleton);
// The pose of `motion` at a frame for a character's skeleton, joints matched by name; joints that the motion
// lacks keep their rest. Throws Failure ("no-common-joint") where no joint is common.
Pose pose_for(const Character& character, const Motion& motion, std::size_t frame);

}  // namespace kinegraph
