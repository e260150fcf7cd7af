#include "nodes/files/gltf_character_out.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace kinegraph {

namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

Json& primitive_of(GltfOut& out, int mesh, int primitive) {
  return out.list("meshes")[at(mesh)].object()["primitives"].array()[at(primitive)];
}

Json::Object& attributes_of(Json& primitive) {
  Json& attributes = primitive.object()["attributes"];
  if (!attributes.is_object()) attributes = Json::Object{};
  return attributes.object();
}

void drop_weights(Json::Object& attributes) {
  for (auto one = attributes.begin(); one != attributes.end();)
    one = one->first.compare(0, 7, "JOINTS_") == 0 || one->first.compare(0, 8, "WEIGHTS_") == 0
              ? attributes.erase(one)
              : std::next(one);
}

// Targets of a primitive from number `first` on.
void add_targets(GltfOut& out, int mesh, int primitive, const MeshPart& part, std::size_t first) {
  Json::Array names, added;
  for (std::size_t k = 0; k < part.morphs.size(); ++k) {
    names.push_back(part.morphs[k].name);
    if (k < first) continue;
    Json::Object target;
    target["POSITION"] = out.add_floats(part.morphs[k].positions, "VEC3", true, GltfTarget::vertices);
    if (!part.morphs[k].normals.empty())
      target["NORMAL"] = out.add_floats(part.morphs[k].normals, "VEC3", false, GltfTarget::vertices);
    added.push_back(std::move(target));
  }
  Json& targets = primitive_of(out, mesh, primitive).object()["targets"];
  if (!targets.is_array()) targets = Json::Array{};
  targets.array().insert(targets.array().end(), added.begin(), added.end());
  Json& owner = out.list("meshes")[at(mesh)];
  Json& extras = owner.object()["extras"];
  if (!extras.is_object()) extras = Json::Object{};
  extras.object()["targetNames"] = std::move(names);
  owner.object().erase("weights");
}

int add_node(GltfOut& out, Json::Object node) {
  out.list("nodes").push_back(std::move(node));
  return static_cast<int>(out.list("nodes").size()) - 1;
}

void add_to(Json& owner, const char* list, int node) {
  Json& nodes = owner.object()[list];
  if (!nodes.is_array()) nodes = Json::Array{};
  nodes.array().push_back(node);
}

Json& scene_of(GltfOut& out) {
  if (out.list("scenes").empty()) out.list("scenes").push_back(Json::Object{});
  const Json* chosen = out.root.find("scene");
  const std::size_t scene = chosen && chosen->is_number() ? static_cast<std::size_t>(chosen->number()) : 0;
  return out.list("scenes")[std::min(scene, out.list("scenes").size() - 1)];
}

void take_from(Json& owner, const char* list, int node) {
  if (!owner.find(list)) return;
  Json::Array& nodes = owner.object()[list].array();
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(),
                             [&](const Json& one) { return one.is_number() && one.number() == node; }),
              nodes.end());
  if (nodes.empty()) owner.object().erase(list);
}

}  // namespace

void add_weights(GltfOut& out, Json& primitive, const MeshPart& part) {
  Json::Object& attributes = attributes_of(primitive);
  const std::size_t width = at(part.influences);
  std::vector<std::vector<std::pair<double, std::uint32_t>>> all(part.vertices());
  std::size_t most = 1;
  for (std::size_t v = 0; v < part.vertices(); ++v) {
    auto& own = all[v];
    double sum = 0;
    for (std::size_t k = 0; k < width; ++k)
      if (const double weight = part.weights[v * width + k]; weight > 0) {
        own.emplace_back(weight, part.joints[v * width + k]);
        sum += weight;
      }
    if (own.empty()) own.emplace_back(sum = 1, 0);
    std::stable_sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [weight, joint] : own) weight /= sum;
    most = std::max(most, own.size());
  }
  drop_weights(attributes);
  for (std::size_t set = 0; 4 * set < most; ++set) {
    std::vector<std::uint32_t> joints(4 * part.vertices());
    std::vector<float> weights(4 * part.vertices());
    for (std::size_t v = 0; v < all.size(); ++v)
      for (std::size_t k = 0; k < 4 && 4 * set + k < all[v].size(); ++k) {
        weights[4 * v + k] = static_cast<float>(all[v][4 * set + k].first);
        joints[4 * v + k] = weights[4 * v + k] > 0 ? all[v][4 * set + k].second : 0;
      }
    attributes["JOINTS_" + std::to_string(set)] = out.add_joints(joints);
    attributes["WEIGHTS_" + std::to_string(set)] =
        out.add_floats(weights, "VEC4", false, GltfTarget::vertices);
  }
}

void add_geometry(GltfOut& out, Json& primitive, const MeshPart& part) {
  Json::Object& attributes = attributes_of(primitive);
  attributes["POSITION"] = out.add_floats(part.positions, "VEC3", true, GltfTarget::vertices);
  if (!part.normals.empty())
    attributes["NORMAL"] = out.add_floats(part.normals, "VEC3", false, GltfTarget::vertices);
  if (!part.texcoords.empty())
    attributes["TEXCOORD_0"] = out.add_floats(part.texcoords, "VEC2", false, GltfTarget::vertices);
  primitive.object()["indices"] = out.add_indices(part.triangles);
}

void put_matrix(std::vector<float>& out, const Affine& map) {
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      out.push_back(i < 3 ? static_cast<float>(map.rows[i][j]) : j == 3 ? 1.0f : 0.0f);
}

void add_new_morphs(GltfOut& out, const Character& character) {
  std::set<std::pair<int, int>> done;
  for (const MeshPart& part : character.parts) {
    if (part.source_mesh < 0 || !done.insert({part.source_mesh, part.source_primitive}).second) continue;
    const Json* had = primitive_of(out, part.source_mesh, part.source_primitive).find("targets");
    const std::size_t count = had && had->is_array() ? had->array().size() : 0;
    if (part.morphs.size() > count) add_targets(out, part.source_mesh, part.source_primitive, part, count);
  }
}

void drop_source_weights(GltfOut& out, const Character& character) {
  for (const MeshPart& part : character.parts)
    if (part.skin >= 0 && part.source_mesh >= 0)
      drop_weights(attributes_of(primitive_of(out, part.source_mesh, part.source_primitive)));
}

std::vector<int> repair_skins(GltfOut& out, const Character& character) {
  std::set<std::pair<int, int>> done;
  std::vector<int> node_of_part, moved(out.list("nodes").size(), -1);
  for (const MeshPart& part : character.parts) {
    node_of_part.push_back(part.source_node);
    if (part.skin < 0 || part.source_node < 0) continue;
    if (done.insert({part.source_mesh, part.source_primitive}).second)
      add_weights(out, primitive_of(out, part.source_mesh, part.source_primitive), part);
    // A skinned mesh doesn't follow its node, so that node may as well stand in the scene.
    int& now = moved[at(part.source_node)];
    if (now < 0) {
      Json::Object& was = out.list("nodes")[at(part.source_node)].object();
      Json::Object node;
      for (const char* key : {"mesh", "skin", "name", "weights"})
        if (auto found = was.find(key); found != was.end()) node[key] = found->second;
      if (was.find("children") == was.end()) {
        now = part.source_node;
        for (Json& other : out.list("nodes")) take_from(other, "children", now);
        take_from(scene_of(out), "nodes", now);
        out.list("nodes")[at(now)] = std::move(node);
      } else {
        for (const char* key : {"mesh", "skin", "weights"}) was.erase(key);
        now = add_node(out, std::move(node));
      }
      add_to(scene_of(out), "nodes", now);
    }
    node_of_part.back() = now;
  }
  return node_of_part;
}

void keep_meshes_of_parts(GltfOut& out, const Character& character) {
  const Json::Array source = out.list("meshes");
  Json::Array meshes;
  for (const MeshPart& part : character.parts) {
    Json::Object mesh;
    mesh["name"] = part.name;
    Json primitive = Json::Object{};
    if (part.source_mesh >= 0) {
      primitive = source[at(part.source_mesh)].find("primitives")->array()[at(part.source_primitive)];
      drop_weights(attributes_of(primitive));
    }
    mesh["primitives"] = Json::Array{std::move(primitive)};
    meshes.push_back(std::move(mesh));
  }
  out.root.object()["meshes"] = std::move(meshes);
}

std::vector<int> add_parts(GltfOut& out, const Character& character, const std::vector<int>& node_of_joint) {
  // A joint's node has the scale of what stands above the root, which a Character's joints have not.
  const double scale = 1 / character.skeleton->above_scale;
  const Affine unscaled = affine({}, {}, {scale, scale, scale});
  for (const Skin& skin : character.skins) {
    Json::Object json;
    if (!skin.name.empty()) json["name"] = skin.name;
    Json::Array joints;
    std::vector<float> binds;
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
      joints.push_back(node_of_joint[at(skin.joints[k])]);
      put_matrix(binds, unscaled * skin.inverse_bind[k]);
    }
    json["joints"] = std::move(joints);
    json["inverseBindMatrices"] = out.add_floats(binds, "MAT4", false);
    out.list("skins").push_back(std::move(json));
  }
  std::vector<int> nodes;
  for (int p = 0; p < static_cast<int>(character.parts.size()); ++p) {
    const MeshPart& part = character.parts[at(p)];
    if (p >= static_cast<int>(out.list("meshes").size())) {
      Json::Object mesh;
      mesh["name"] = part.name;
      mesh["primitives"] = Json::Array{Json(Json::Object{})};
      out.list("meshes").push_back(std::move(mesh));
    }
    Json& primitive = primitive_of(out, p, 0);
    if (part.source_mesh < 0) add_geometry(out, primitive, part);
    const Json* had = primitive.find("targets");
    const std::size_t count = had && had->is_array() ? had->array().size() : 0;
    if (part.skin >= 0) add_weights(out, primitive, part);
    if (!part.morphs.empty()) add_targets(out, p, 0, part, count);
    Json::Object node;
    node["name"] = part.name;
    node["mesh"] = p;
    if (part.skin >= 0) {
      node["skin"] = part.skin;
    } else if (const Affine map = part.joint >= 0 ? unscaled * part.placed : part.placed; map != Affine{}) {
      const Decomposed placed = decomposed(map);
      node["translation"] = Json::Array{placed.move.x, placed.move.y, placed.move.z};
      node["rotation"] = Json::Array{placed.turned.x, placed.turned.y, placed.turned.z, placed.turned.w};
      node["scale"] = Json::Array{placed.scale.x, placed.scale.y, placed.scale.z};
    }
    nodes.push_back(add_node(out, std::move(node)));
    if (part.skin < 0 && part.joint >= 0) {
      add_to(out.list("nodes")[at(node_of_joint[at(part.joint)])], "children", nodes.back());
    } else {
      add_to(scene_of(out), "nodes", nodes.back());
    }
  }
  return nodes;
}

}  // namespace kinegraph
