#include "nodes/files/fbx_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/files/fbx_scene.h"
#include "nodes/files/gltf_character_out.h"
#include "nodes/files/gltf_out.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/up_axis.h"

namespace kinegraph {

namespace {

// From the file's axes to right, up and front.
Affine turned_up(const FbxScene& scene, const ReadOptions& options, UpAxis& up) {
  Affine turn;
  if (options.up == "auto") {
    for (int i = 0; i < 3; ++i) {
      turn.rows[i] = {0, 0, 0, 0};
      turn.rows[i][scene.axes[i]] = scene.signs[i];
    }
    up = scene.axes[1] == 2 ? UpAxis::z : UpAxis::y;
    // Settings that mirror are wrong; a front of the other sign is the likeliest slip.
    if (determinant(turn) < 0)
      for (double& number : turn.rows[2]) number = -number;
    return turn;
  }
  up = options.up == "z" ? UpAxis::z : UpAxis::y;
  for (int j = 0; j < 3; ++j) {
    Vec3 axis;
    axis[j] = 1;
    const Vec3 to = y_up(axis, up);
    for (int i = 0; i < 3; ++i) turn.rows[i][j] = to[i];
  }
  return turn;
}

Json json_numbers(std::initializer_list<double> values) {
  Json::Array list;
  for (double value : values) list.push_back(value);
  return list;
}

void place(Json::Object& node, const Affine& local) {
  const Decomposed parts = decomposed(local);
  node["translation"] = json_numbers({parts.move.x, parts.move.y, parts.move.z});
  node["rotation"] = json_numbers({parts.turned.x, parts.turned.y, parts.turned.z, parts.turned.w});
  node["scale"] = json_numbers({parts.scale.x, parts.scale.y, parts.scale.z});
}

// Where nodes stand while nothing moves: bones as they were bound, the others as the file has them.
std::vector<Affine> rest_of(const FbxScene& scene) {
  std::vector<Affine> world(scene.nodes.size()), rest(scene.nodes.size());
  std::vector<const FbxScene::Bone*> bound(scene.nodes.size());
  std::vector<int> by(scene.nodes.size());
  for (const FbxScene::Mesh& mesh : scene.meshes)
    for (const FbxScene::Bone& bone : mesh.bones) {
      bound[bone.node] = &bone;
      by[bone.node] = mesh.node;
    }
  std::vector<Affine> as_written(scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const FbxScene::Node& node = scene.nodes[i];
    as_written[i] = node.parent < 0 ? node.local : as_written[node.parent] * node.local;
  }
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const FbxScene::Node& node = scene.nodes[i];
    const Affine above = node.parent < 0 ? Affine{} : world[node.parent];
    const bool usable = bound[i] && std::fabs(determinant(bound[i]->inverse_bind)) > 1e-18;
    world[i] = usable ? as_written[by[i]] * inverse(bound[i]->inverse_bind) : above * node.local;
    rest[i] = usable ? inverse(above) * world[i] : node.local;
  }
  return rest;
}

bool apart(const Affine& a, const Affine& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      if (std::fabs(a.rows[i][j] - b.rows[i][j]) > 1e-6 * (1 + std::fabs(b.rows[i][j]))) return true;
  return false;
}

class ClipOut {
 public:
  ClipOut(GltfOut& out, const FbxScene::Clip& clip, double rate) : out_(out), name_(clip.name) {
    std::vector<float> times(clip.frames);
    for (std::size_t t = 0; t < times.size(); ++t)
      times[t] = static_cast<float>(static_cast<double>(t) / rate);
    input_ = out.add_floats(times, "SCALAR", true);
  }
  void add(int node, const std::vector<Affine>& local) {
    std::vector<float> places, turns, scales;
    bool scaled = false;
    const Vec3 first = decomposed(local.front()).scale;
    auto put = [](std::vector<float>& to, std::initializer_list<double> values) {
      for (double value : values) to.push_back(static_cast<float>(value));
    };
    for (const Affine& one : local) {
      const Decomposed parts = decomposed(one);
      put(places, {parts.move.x, parts.move.y, parts.move.z});
      put(turns, {parts.turned.x, parts.turned.y, parts.turned.z, parts.turned.w});
      put(scales, {parts.scale.x, parts.scale.y, parts.scale.z});
      scaled = scaled || norm(parts.scale - first) > 1e-3 * norm(first);
    }
    channel(node, "rotation", out_.add_floats(turns, "VEC4", false));
    channel(node, "translation", out_.add_floats(places, "VEC3", false));
    if (scaled) channel(node, "scale", out_.add_floats(scales, "VEC3", false));
  }
  void finish() {
    if (channels_.empty()) return;
    out_.list("animations")
        .push_back(Json::Object{
            {"name", name_}, {"samplers", std::move(samplers_)}, {"channels", std::move(channels_)}});
  }

 private:
  void channel(int node, const char* path, int output) {
    channels_.push_back(Json::Object{{"sampler", samplers_.size()},
                                     {"target", Json::Object{{"node", node}, {"path", path}}}});
    samplers_.push_back(Json::Object{{"input", input_}, {"output", output}});
  }
  GltfOut& out_;
  std::string name_;
  int input_ = 0;
  Json::Array samplers_, channels_;
};

// Nodes that stand still over everything that moves are no joints: the object that an armature hangs on.
std::vector<bool> joints_of(const FbxScene& scene, const std::vector<Affine>& rest) {
  std::vector<bool> joint(scene.nodes.size()), keyed(joint);
  for (const FbxScene::Mesh& mesh : scene.meshes)
    for (const FbxScene::Bone& bone : mesh.bones) joint[bone.node] = true;
  for (const FbxScene::Clip& clip : scene.clips)
    for (const FbxScene::Track& track : clip.tracks) {
      keyed[track.node] = true;
      for (const Affine& local : track.local)
        if (apart(local, rest[track.node]) && apart(local, track.local.front())) joint[track.node] = true;
    }
  for (std::size_t i = 0; i < joint.size(); ++i)
    if (const int parent = scene.nodes[i].parent; keyed[i] && parent >= 0 && joint[parent]) joint[i] = true;
  return joint;
}

void add_clips(GltfOut& out, const FbxScene& scene, const std::vector<Affine>& rest, Work& work) {
  const std::vector<bool> joint = joints_of(scene, rest);
  for (const FbxScene::Clip& clip : scene.clips) {
    work.check();
    if (clip.frames == 0) continue;
    ClipOut written(out, clip, scene.rate > 0 ? scene.rate : 30);
    std::vector<bool> has(scene.nodes.size());
    for (const FbxScene::Track& track : clip.tracks) {
      if (!joint[track.node]) continue;
      has[track.node] = true;
      written.add(track.node, track.local);
    }
    // Bones without keys stand as the file has them, which may not be how they were bound.
    for (std::size_t i = 0; i < has.size(); ++i)
      if (!has[i] && joint[i] && apart(scene.nodes[i].local, rest[i]))
        written.add(static_cast<int>(i), std::vector<Affine>(clip.frames, scene.nodes[i].local));
    written.finish();
  }
}

void add_meshes(GltfOut& out, const FbxScene& scene) {
  for (const FbxScene::Mesh& mesh : scene.meshes) {
    Json primitive = Json::Object{};
    add_geometry(out, primitive, mesh.part);
    if (!mesh.bones.empty()) add_weights(out, primitive, mesh.part);
    out.list("meshes").push_back(
        Json::Object{{"name", mesh.part.name}, {"primitives", Json::Array{std::move(primitive)}}});
    Json::Object node{{"name", mesh.part.name}, {"mesh", out.list("meshes").size() - 1}};
    if (!mesh.bones.empty()) {
      Json::Array joints;
      std::vector<float> binds;
      for (const FbxScene::Bone& bone : mesh.bones) {
        joints.push_back(bone.node);
        put_matrix(binds, bone.inverse_bind);
      }
      out.list("skins").push_back(
          Json::Object{{"name", mesh.part.name},
                       {"joints", std::move(joints)},
                       {"inverseBindMatrices", out.add_floats(binds, "MAT4", false)}});
      node["skin"] = out.list("skins").size() - 1;
    }
    const std::size_t index = out.list("nodes").size();
    out.list("nodes").push_back(std::move(node));
    // Skinned meshes stand in the scene, rigid ones on their node.
    if (mesh.bones.empty()) {
      Json& children = out.list("nodes")[static_cast<std::size_t>(mesh.node)].object()["children"];
      if (!children.is_array()) children = Json::Array{};
      children.array().push_back(index);
    } else {
      out.list("scenes")[0].object()["nodes"].array().push_back(index);
    }
  }
}

// Of a file that holds nothing but a skeleton the nodes are what a skin would name, but for a node over the
// whole that stands for the armature.
void add_bare_skeleton(GltfOut& out, const FbxScene& scene) {
  if (!scene.meshes.empty() || !scene.clips.empty()) return;
  std::vector<std::size_t> children(scene.nodes.size());
  for (const FbxScene::Node& node : scene.nodes)
    if (node.parent >= 0) ++children[static_cast<std::size_t>(node.parent)];
  std::size_t first = 1;
  if (scene.nodes.size() > 2 && children[0] == 1 && children[1] == 1 &&
      decomposed(scene.nodes[1].local).move == Vec3{})
    first = 2;
  Json::Array joints;
  for (std::size_t i = first; i < scene.nodes.size(); ++i) joints.push_back(i);
  if (!joints.empty()) out.list("skins").push_back(Json::Object{{"joints", std::move(joints)}});
}

}  // namespace

GltfContents read_fbx(std::string_view bytes, const ReadOptions& options, FileAccess& files, Work& work) {
  FbxScene scene = fbx_scene(bytes, work);
  GltfOrigin origin;
  origin.format = "fbx";
  origin.unit = unit_from_param(options.unit, unit_of_metres(scene.centimetres / 100));
  origin.rate = scene.rate;
  const double size = origin.unit.metres;
  scene.nodes[0].local =
      affine({}, {}, {size, size, size}) * turned_up(scene, options, origin.up) * scene.nodes[0].local;
  const std::vector<Affine> rest = rest_of(scene);

  GltfOut out;
  out.root.object()["asset"] = Json::Object{{"version", "2.0"}, {"generator", "Kinegraph, from FBX"}};
  Json::Array nodes;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    Json::Object node;
    if (!scene.nodes[i].name.empty()) node["name"] = scene.nodes[i].name;
    place(node, rest[i]);
    nodes.push_back(std::move(node));
    if (const int parent = scene.nodes[i].parent; parent >= 0) {
      Json& children = nodes[static_cast<std::size_t>(parent)].object()["children"];
      if (!children.is_array()) children = Json::Array{};
      children.array().push_back(i);
    }
  }
  out.root.object()["nodes"] = std::move(nodes);
  out.root.object()["scenes"] = Json::Array{Json::Object{{"nodes", Json::Array{Json(0)}}}};
  out.root.object()["scene"] = 0;
  add_meshes(out, scene);
  add_clips(out, scene, rest, work);
  add_bare_skeleton(out, scene);

  if (std::any_of(scene.clips.begin(), scene.clips.end(), [](const auto& clip) { return clip.sparse; }))
    work.report(warning("sparse-keys", "frames between keys are taken as straight, not by the file's curves")
                    .hinting("bake the animation, a key a frame, when the FBX is written"));
  ReadOptions in_metres = options;
  in_metres.unit = Json("m");
  return read_gltf(out.glb(work), "/clip.glb", in_metres, files, work, origin);
}

}  // namespace kinegraph
