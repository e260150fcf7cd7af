#include "nodes/files/gltf_inventory.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "nodes/files/gltf_file.h"

namespace kinegraph {

namespace {

GltfInventory::Clip clip_of(const GltfFile& file, const tinygltf::Animation& animation, std::size_t index) {
  GltfInventory::Clip clip{animation.name.empty() ? fmt::format("{}", index) : animation.name};
  clip.channels = animation.channels.size();
  std::set<std::string> kinds;
  for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
    kinds.insert(sampler.interpolation.empty() ? "LINEAR" : sampler.interpolation);
    const std::vector<double> times = gltf_numbers(file, sampler.input, 1);
    clip.keys = std::max(clip.keys, times.size());
    if (!times.empty()) clip.seconds = std::max(clip.seconds, times.back());
  }
  for (const std::string& kind : kinds) clip.interpolation += (clip.interpolation.empty() ? "" : ", ") + kind;
  return clip;
}

int accessor_of(const tinygltf::Primitive& primitive, const std::string& attribute) {
  const auto found = primitive.attributes.find(attribute);
  return found == primitive.attributes.end() ? -1 : found->second;
}

void look_at_weights(const GltfFile& file, const tinygltf::Primitive& primitive, std::size_t vertices,
                     GltfInventory& out) {
  std::vector<double> sums(vertices);
  std::vector<int> used(vertices);
  bool any = false;
  for (int set = 0;; ++set) {
    const int at = accessor_of(primitive, fmt::format("WEIGHTS_{}", set));
    if (at < 0) break;
    const std::vector<double> weights = gltf_numbers(file, at, 4);
    for (std::size_t i = 0; i < std::min(weights.size(), 4 * vertices); ++i) {
      sums[i / 4] += weights[i];
      used[i / 4] += weights[i] != 0;
    }
    any = true;
  }
  if (!any) return;
  for (std::size_t v = 0; v < vertices; ++v) {
    const double miss = std::fabs(sums[v] - 1);
    if (miss <= 2e-7 * std::max(used[v], 1)) continue;
    ++out.uneven_vertices;
    out.uneven_most = std::max(out.uneven_most, miss);
  }
}

GltfInventory::Mesh mesh_of(const GltfFile& file, const tinygltf::Mesh& mesh, std::size_t index,
                            GltfInventory& out) {
  GltfInventory::Mesh one{mesh.name.empty() ? fmt::format("{}", index) : mesh.name};
  one.primitives = mesh.primitives.size();
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    const int positions = accessor_of(primitive, "POSITION");
    if (positions < 0) continue;
    const std::size_t vertices = gltf_count(file, positions);
    const std::size_t corners = primitive.indices >= 0 ? gltf_count(file, primitive.indices) : vertices;
    one.vertices += vertices;
    const bool strip =
        primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP || primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    if (strip) one.triangles += corners > 2 ? corners - 2 : 0;
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode < 0) one.triangles += corners / 3;
    one.morphs = std::max(one.morphs, primitive.targets.size());
    if (accessor_of(primitive, "WEIGHTS_0") < 0) continue;
    one.skinned = true;
    look_at_weights(file, primitive, vertices, out);
  }
  return one;
}

}  // namespace

GltfInventory gltf_inventory(std::string_view bytes, const std::string& path, FileAccess& files) {
  const GltfFile file = read_gltf_file(bytes, path, files);
  const tinygltf::Model& model = *file.model;
  GltfInventory out;
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    out.clips.push_back(clip_of(file, model.animations[i], i));
  for (std::size_t i = 0; i < model.skins.size(); ++i)
    out.skins.push_back({model.skins[i].name.empty() ? fmt::format("{}", i) : model.skins[i].name,
                         model.skins[i].joints.size()});
  for (std::size_t i = 0; i < model.meshes.size(); ++i)
    out.meshes.push_back(mesh_of(file, model.meshes[i], i, out));
  out.materials = model.materials.size();
  out.textures = model.images.size();
  for (const tinygltf::Node& parent : model.nodes)
    for (int child : parent.children)
      if (child >= 0 && child < static_cast<int>(model.nodes.size()) && model.nodes[child].skin >= 0)
        out.skinned_below.push_back(model.nodes[child].name.empty() ? fmt::format("node{}", child)
                                                                    : model.nodes[child].name);
  return out;
}

}  // namespace kinegraph
