#include "nodes/files/gltf_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "graph/file/parse_json.h"
#include "nodes/files/gltf_character_out.h"
#include "nodes/files/gltf_file.h"
#include "nodes/files/gltf_morphs.h"
#include "nodes/files/stretch.h"

namespace kinegraph {

namespace {

// Where the joints of a skeleton are among the nodes of the file.
struct JointNodes {
  std::vector<int> node;      // -1: none
  std::vector<double> scale;  // metres a unit of the node's translation
};

Json json_numbers(std::initializer_list<double> values) {
  Json::Array list;
  for (double value : values) list.push_back(static_cast<double>(static_cast<float>(value)));
  return list;
}

Json::Object node_of(const std::string& name, Vec3 move, Quat turned) {
  Json::Object node;
  if (!name.empty()) node["name"] = name;
  if (move != Vec3{}) node["translation"] = json_numbers({move.x, move.y, move.z});
  if (turned != Quat{}) node["rotation"] = json_numbers({turned.x, turned.y, turned.z, turned.w});
  return node;
}

int add_node(GltfOut& out, Json::Object node) {
  out.list("nodes").push_back(std::move(node));
  return static_cast<int>(out.list("nodes").size()) - 1;
}

void add_child(GltfOut& out, int parent, int child) {
  Json& children = out.list("nodes")[static_cast<std::size_t>(parent)].object()["children"];
  if (!children.is_array()) children = Json::Array{};
  children.array().push_back(child);
}

// The whole skeleton as new nodes, End Sites as leaves; what stands above it as a node over its root.
JointNodes add_skeleton(GltfOut& out, const Skeleton& skeleton) {
  JointNodes nodes;
  int above = -1;
  if (skeleton.above != Quat{} || skeleton.above_offset != Vec3{} || skeleton.above_scale != 1) {
    Json::Object node = node_of("above", skeleton.above_offset, skeleton.above);
    if (const double scale = skeleton.above_scale; scale != 1)
      node["scale"] = json_numbers({scale, scale, scale});
    above = add_node(out, std::move(node));
  }
  for (const Joint& joint : skeleton.joints) {
    const int node = add_node(out, node_of(joint.name, joint.offset, joint.rest));
    if (const int parent = joint.parent < 0 ? above : nodes.node[joint.parent]; parent >= 0)
      add_child(out, parent, node);
    nodes.node.push_back(node);
    nodes.scale.push_back(1);
  }
  for (const EndSite& end : skeleton.ends)
    add_child(out, nodes.node[end.joint],
              add_node(out, node_of(end.name.empty() ? skeleton.joints[end.joint].name + "_end" : end.name,
                                    end.offset, {})));
  if (!skeleton.joints.empty()) {
    Json::Object scene;
    scene["nodes"] = Json::Array{Json(above >= 0 ? above : nodes.node[0])};
    out.root.object()["scenes"] = Json::Array{std::move(scene)};
    out.root.object()["scene"] = 0;
  }
  return nodes;
}

// A node that an animation moves may not have a matrix.
void without_matrix(Json& node) {
  const Json* matrix = node.find("matrix");
  if (!matrix || !matrix->is_array() || matrix->array().size() != 16) return;
  Affine map;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) map.rows[i][j] = matrix->array()[4 * j + i].number();
  const Decomposed parts = decomposed(map);
  node.object().erase("matrix");
  node.object()["translation"] = json_numbers({parts.move.x, parts.move.y, parts.move.z});
  node.object()["rotation"] = json_numbers({parts.turned.x, parts.turned.y, parts.turned.z, parts.turned.w});
  node.object()["scale"] = json_numbers({parts.scale.x, parts.scale.y, parts.scale.z});
}

// A forest's made-up root becomes a node over the scene's nodes once a motion moves it.
int node_over_scene(GltfOut& out, const std::string& name) {
  const int node = add_node(out, node_of(name, {}, {}));
  const Json* chosen = out.root.find("scene");
  const std::size_t scene = chosen && chosen->is_number() ? static_cast<std::size_t>(chosen->number()) : 0;
  if (scene >= out.list("scenes").size()) return node;
  Json& roots = out.list("scenes")[scene].object()["nodes"];
  if (roots.is_array() && !roots.array().empty())
    out.list("nodes").back().object()["children"] = roots.array();
  roots = Json::Array{Json(node)};
  return node;
}

class Animation {
 public:
  Animation(GltfOut& out, std::size_t frames, double fps) : out_(out) {
    std::vector<float> times(frames);
    for (std::size_t t = 0; t < frames; ++t) times[t] = static_cast<float>(static_cast<double>(t) / fps);
    input_ = out.add_floats(times, "SCALAR", true);
  }
  void add(int node, const char* path, const char* type, std::span<const float> values) {
    Json::Object sampler, target, channel;
    sampler["input"] = input_;
    sampler["output"] = out_.add_floats(values, type, false);
    target["node"] = node;
    target["path"] = path;
    channel["sampler"] = samplers_.size();
    channel["target"] = std::move(target);
    samplers_.push_back(std::move(sampler));
    channels_.push_back(std::move(channel));
  }
  void finish() {
    if (channels_.empty()) return;
    Json::Object animation;
    animation["name"] = "motion";
    animation["samplers"] = std::move(samplers_);
    animation["channels"] = std::move(channels_);
    out_.list("animations").push_back(std::move(animation));
  }

 private:
  GltfOut& out_;
  int input_;
  Json::Array samplers_, channels_;
};

void put(std::vector<float>& out, Quat q) {
  q = normalized(q);
  for (double value : {q.x, q.y, q.z, q.w}) out.push_back(static_cast<float>(value));
}
void put(std::vector<float>& out, Vec3 v) {
  for (double value : {v.x, v.y, v.z}) out.push_back(static_cast<float>(value));
}

void add_motion(GltfOut& out, Animation& animation, const Motion& motion, const Skeleton& skeleton,
                JointNodes nodes, Work& work) {
  const Skeleton& from = motion.skeleton();
  const bool same_above = from.above == skeleton.above && from.above_offset == skeleton.above_offset &&
                          from.above_scale == skeleton.above_scale;
  std::size_t common = 0;
  for (int j = 0; j < skeleton.size(); ++j) {
    work.check();
    const int k = motion.shared_skeleton().get() == &skeleton ? j : from.find(skeleton.joints[j].name);
    if (k < 0) continue;
    ++common;
    const bool root = skeleton.joints[j].parent < 0;
    std::vector<float> turns, places;
    double turned = 0, moved = 0;
    turns.reserve(4 * motion.frames());
    places.reserve(3 * motion.frames());
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      if (t % 4096 == 0) work.check();
      Quat turn_now = motion.rotation(k)[t];
      Vec3 place = motion.local_offset(k, t);
      if (root && !same_above) {
        turn_now = inverse(skeleton.above) * from.above * turn_now;
        place =
            rotate(inverse(skeleton.above),
                   from.above_offset + rotate(from.above, from.above_scale * place) - skeleton.above_offset) /
            skeleton.above_scale;
      }
      turned = std::max(turned, turn(turn_now, skeleton.joints[j].rest));
      moved = std::max(moved, norm(place - skeleton.joints[j].offset));
      put(turns, turn_now);
      put(places, place / nodes.scale[j]);
    }
    if (nodes.node[j] < 0) {
      if (turned == 0 && moved == 0) continue;
      nodes.node[j] = node_over_scene(out, skeleton.joints[j].name);
    }
    without_matrix(out.list("nodes")[static_cast<std::size_t>(nodes.node[j])]);
    animation.add(nodes.node[j], "rotation", "VEC4", turns);
    if ((root && moved > 0) || (motion.translates(k) && moved > 0))
      animation.add(nodes.node[j], "translation", "VEC3", places);
  }
  if (common == 0)
    throw Failure(error("no-common-joint", "the motion and the character have no joint of the same name")
                      .hinting("put the motion on the character's skeleton with Retarget"));
  if (common < from.joints.size())
    work.report(warning("no-partner", fmt::format("{} of the motion's {} joints are none of the character's",
                                                  from.joints.size() - common, from.joints.size())));
}

// One channel a node: all its targets' weights, frame after frame.
void add_morphs(Animation& animation, const Character& character, const std::vector<int>& node_of_part) {
  std::set<int> done;
  for (const MorphTrack& track : character.morph_tracks) {
    const int node = node_of_part[track.part];
    if (node < 0 || !done.insert(node).second) continue;
    const std::size_t targets = character.parts[track.part].morphs.size(), frames = track.weights.size();
    std::vector<float> weights(targets * frames);
    for (const MorphTrack& one : character.morph_tracks)
      if (one.part == track.part)
        for (std::size_t t = 0; t < std::min(frames, one.weights.size()); ++t)
          weights[t * targets + static_cast<std::size_t>(one.target)] = static_cast<float>(one.weights[t]);
    animation.add(node, "weights", "SCALAR", weights);
  }
}

Json source_json(const CharacterSource& source) {
  Diagnostics problems;
  Json json = parse_json(source.json, "", problems);
  if (!json.is_object()) bad_gltf("the source's JSON can't be read");
  return json;
}

// Bones are what a skin names; programs take the joints of a motion without a mesh for bones by it.
void add_bare_skin(GltfOut& out, const Skeleton& skeleton, const JointNodes& nodes) {
  Json::Array joints;
  for (int node : nodes.node) joints.push_back(node);
  if (joints.empty()) return;
  std::vector<float> binds;
  const RestPose rest = rest_pose(skeleton);
  for (int j = 0; j < skeleton.size(); ++j)
    put_matrix(binds, inverse(affine(rest.positions[j], rest.orientations[j],
                                     skeleton.above_scale * Vec3{1, 1, 1})));
  Json::Object skin;
  skin["joints"] = std::move(joints);
  skin["inverseBindMatrices"] = out.add_floats(binds, "MAT4", false);
  out.list("skins").push_back(std::move(skin));
}

}  // namespace

GltfOut gltf_of(const Motion* given, const Character* meant, const WriteOptions& options, Work& work) {
  GltfOut out;
  if (meant && meant->source) out.root = source_json(*meant->source);
  Character within;
  const Character* character = meant;
  if (meant && !meant->morph_tracks.empty()) {
    within = with_weights_from_0_to_1(*meant, source_targets(*meant, out.root));
    character = &within;
  }
  Motion kept;
  const Motion* motion = given;
  if (given && options.stretch != "keep") {
    kept = without_stretch(*given, options.stretch, work);
    motion = &kept;
  }
  const bool animates = motion || (character && !character->morph_tracks.empty());
  const Skeleton& skeleton = character ? *character->skeleton : motion->skeleton();
  JointNodes nodes;
  std::vector<int> node_of_part;
  if (character && character->source && !character->rebound) {
    const CharacterSource& source = *character->source;
    if (animates) out.root.object().erase("animations");
    if (options.repair) drop_source_weights(out, *character);
    out.carry_over(source, options.repair);
    nodes = {source.node_of_joint, source.scale_of_parent};
    for (const MeshPart& part : character->parts) node_of_part.push_back(part.source_node);
    add_new_morphs(out, *character);
    if (options.repair) node_of_part = repair_skins(out, *character);
  } else {
    if (character && character->source) {
      for (const char* gone : {"animations", "nodes", "skins", "scenes", "scene", "cameras"})
        out.root.object().erase(gone);
      keep_meshes_of_parts(out, *character);
      out.carry_over(*character->source, true);
    } else {
      Json::Object asset;
      asset["version"] = "2.0";
      asset["generator"] = "Kinegraph";
      out.root.object()["asset"] = std::move(asset);
    }
    nodes = add_skeleton(out, skeleton);
    if (character) {
      node_of_part = add_parts(out, *character, nodes.node);
    } else {
      add_bare_skin(out, skeleton, nodes);
    }
  }
  if (animates) {
    const std::size_t frames = motion ? motion->frames() : character->morph_tracks.front().weights.size();
    const double fps = motion ? motion->fps() : character->morph_fps;
    if (frames > 0) {
      Animation animation(out, frames, fps);
      if (motion) add_motion(out, animation, *motion, skeleton, nodes, work);
      if (character && !character->morph_tracks.empty() &&
          (character->morph_fps == fps && character->morph_tracks.front().weights.size() == frames))
        add_morphs(animation, *character, node_of_part);
      animation.finish();
    }
  }
  return out;
}

}  // namespace kinegraph
