#include "nodes/files/gltf_mesh.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>

namespace kinegraph {

namespace {

std::vector<float> floats(const GltfFile& file, int accessor, int components) {
  const std::vector<double> numbers = gltf_numbers(file, accessor, components);
  return std::vector<float>(numbers.begin(), numbers.end());
}

int attribute(const std::map<std::string, int>& attributes, const std::string& name) {
  auto found = attributes.find(name);
  return found == attributes.end() ? -1 : found->second;
}

std::vector<std::uint32_t> triangles_of(const GltfFile& file, const tinygltf::Primitive& primitive,
                                        std::size_t vertices) {
  std::vector<std::uint32_t> corners;
  if (primitive.indices >= 0) {
    for (double index : gltf_numbers(file, primitive.indices, 1)) {
      if (index >= static_cast<double>(vertices))
        bad_gltf(fmt::format("a triangle has the vertex {:g}", index));
      corners.push_back(static_cast<std::uint32_t>(index));
    }
  } else {
    for (std::size_t i = 0; i < vertices; ++i) corners.push_back(static_cast<std::uint32_t>(i));
  }
  if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP || primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    std::vector<std::uint32_t> out;
    const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const std::size_t odd = fan ? 0 : i % 2;
      out.insert(out.end(), {corners[fan ? 0 : i - 2 + odd], corners[i - 1 - odd], corners[i]});
    }
    return out;
  }
  corners.resize(corners.size() / 3 * 3);
  return corners;
}

// Influences of all sets together; false where the primitive has none.
bool read_weights(const GltfFile& file, const tinygltf::Primitive& primitive, std::size_t joints,
                  MeshPart& part) {
  std::vector<std::vector<double>> indices, weights;
  for (int set = 0;; ++set) {
    const int of_joints = attribute(primitive.attributes, fmt::format("JOINTS_{}", set));
    const int of_weights = attribute(primitive.attributes, fmt::format("WEIGHTS_{}", set));
    if (of_joints < 0 || of_weights < 0) break;
    indices.push_back(gltf_numbers(file, of_joints, 4));
    weights.push_back(gltf_numbers(file, of_weights, 4));
    if (indices.back().size() != 4 * part.vertices() || weights.back().size() != 4 * part.vertices())
      bad_gltf("a mesh has other weights than vertices");
  }
  if (indices.empty()) return false;
  part.influences = static_cast<int>(4 * indices.size());
  for (std::size_t v = 0; v < part.vertices(); ++v)
    for (std::size_t set = 0; set < indices.size(); ++set)
      for (std::size_t k = 0; k < 4; ++k) {
        double joint = indices[set][4 * v + k];
        const double weight = weights[set][4 * v + k];
        if (joint < 0 || joint >= static_cast<double>(joints)) {
          if (weight != 0) bad_gltf(fmt::format("a vertex hangs on joint {:g} of {}", joint, joints));
          joint = 0;
        }
        part.joints.push_back(static_cast<std::uint32_t>(joint));
        part.weights.push_back(static_cast<float>(weight));
      }
  return true;
}

void read_morphs(const GltfFile& file, const tinygltf::Mesh& mesh, const tinygltf::Primitive& primitive,
                 MeshPart& part) {
  for (std::size_t k = 0; k < primitive.targets.size(); ++k) {
    MorphTarget morph;
    morph.name = fmt::format("target{}", k);
    if (mesh.extras.IsObject() && mesh.extras.Has("targetNames"))
      if (const tinygltf::Value& names = mesh.extras.Get("targetNames");
          names.IsArray() && k < names.ArrayLen() && names.Get(k).IsString())
        morph.name = names.Get(k).Get<std::string>();
    morph.positions.resize(part.positions.size());
    if (const int at = attribute(primitive.targets[k], "POSITION"); at >= 0)
      morph.positions = floats(file, at, 3);
    if (const int at = attribute(primitive.targets[k], "NORMAL"); at >= 0)
      morph.normals = floats(file, at, 3);
    if (morph.positions.size() != part.positions.size() ||
        (!morph.normals.empty() && morph.normals.size() != part.positions.size()))
      bad_gltf("a morph target has other vertices than its mesh");
    part.morphs.push_back(std::move(morph));
  }
}

}  // namespace

Character gltf_character(const GltfFile& file, const GltfNodes& nodes, double metres) {
  const tinygltf::Model& model = *file.model;
  Character character;
  character.skeleton = nodes.skeleton;
  character.unit = metres;
  const RestPose rest = rest_pose(*nodes.skeleton);
  const Affine in_metres = affine({}, {}, {metres, metres, metres});
  auto from_joint = [&](int joint) {
    return inverse(affine(rest.positions[joint], rest.orientations[joint])) * in_metres;
  };
  for (const tinygltf::Skin& one : model.skins) {
    Skin skin;
    skin.name = one.name;
    std::vector<double> binds;
    if (one.inverseBindMatrices >= 0) {
      binds = gltf_numbers(file, one.inverseBindMatrices, 16);
      if (binds.size() < 16 * one.joints.size()) bad_gltf("a skin has fewer matrices than joints");
    }
    for (std::size_t k = 0; k < one.joints.size(); ++k) {
      const int node = one.joints[k], joint = nodes.joint_of_node[node];
      Affine bind;
      if (!binds.empty())
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 4; ++j) bind.rows[i][j] = binds[16 * k + 4 * j + i];
      skin.joints.push_back(joint);
      skin.inverse_bind.push_back(from_joint(joint) * nodes.world[node] * bind);
    }
    character.skins.push_back(std::move(skin));
  }
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    const tinygltf::Node& one = model.nodes[node];
    if (one.mesh < 0) continue;
    if (one.mesh >= static_cast<int>(model.meshes.size()) || one.skin >= static_cast<int>(model.skins.size()))
      bad_gltf(fmt::format("node {} names no mesh or skin that is there", node));
    const tinygltf::Mesh& mesh = model.meshes[one.mesh];
    int joint = -1;
    for (int at = static_cast<int>(node); at >= 0 && joint < 0; at = nodes.parent[at])
      joint = nodes.joint_of_node[at];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = mesh.primitives[p];
      const int at = attribute(primitive.attributes, "POSITION");
      if (at < 0 || (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES)) continue;
      MeshPart part;
      part.name = !one.name.empty()    ? one.name
                  : !mesh.name.empty() ? mesh.name
                                       : fmt::format("mesh{}", one.mesh);
      if (mesh.primitives.size() > 1) part.name += fmt::format(".{}", p);
      part.positions = floats(file, at, 3);
      if (const int normals = attribute(primitive.attributes, "NORMAL"); normals >= 0)
        part.normals = floats(file, normals, 3);
      if (const int texcoords = attribute(primitive.attributes, "TEXCOORD_0"); texcoords >= 0)
        part.texcoords = floats(file, texcoords, 2);
      if ((!part.normals.empty() && part.normals.size() != part.positions.size()) ||
          (!part.texcoords.empty() && part.texcoords.size() != 2 * part.vertices()))
        bad_gltf(fmt::format("mesh {} has attributes of different lengths", one.mesh));
      part.triangles = triangles_of(file, primitive, part.vertices());
      part.source_node = static_cast<int>(node);
      part.source_mesh = one.mesh;
      part.source_primitive = static_cast<int>(p);
      if (one.skin >= 0 && read_weights(file, primitive, character.skins[one.skin].joints.size(), part)) {
        part.skin = one.skin;
      } else {
        part.joint = joint;
        part.placed = (joint >= 0 ? from_joint(joint) : in_metres) * nodes.world[node];
      }
      read_morphs(file, mesh, primitive, part);
      character.parts.push_back(std::move(part));
    }
  }
  auto source = std::make_shared<CharacterSource>();
  source->json = file.json;
  source->buffers = file.buffers;
  source->files = file.images;
  source->node_of_joint = nodes.node_of_joint;
  source->scale_of_parent = nodes.scale_of_parent;
  character.source = std::move(source);
  return character;
}

}  // namespace kinegraph
