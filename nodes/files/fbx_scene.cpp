#include "nodes/files/fbx_scene.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>

#include "nodes/files/decimal.h"

namespace kinegraph {

namespace {

Affine affine_of(const aiMatrix4x4& m) {
  Affine out;
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 4; ++j) out.rows[i][j] = static_cast<double>(m[i][j]);
  return out;
}
Vec3 vec3_of(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}
Quat quat_of(const aiQuaternion& q) {
  return normalized(Quat{q.x, q.y, q.z, q.w});
}

bool is_helper(const aiNode& node) {
  return std::string_view(node.mName.C_Str()).find("_$AssimpFbx$_") != std::string_view::npos;
}

// Keys at a time: `between(a, b, part)`; held before the first and after the last.
template <class Key, class Value, class Convert, class Between>
Value value_at(const Key* keys, unsigned count, double time, Convert convert, Between between) {
  const Key* end = keys + count;
  const Key* next = std::lower_bound(keys, end, time, [](const Key& key, double t) { return key.mTime < t; });
  if (next == end) return convert(end[-1].mValue);
  if (next == keys || next->mTime == time) return convert(next->mValue);
  const double part = (time - next[-1].mTime) / (next->mTime - next[-1].mTime);
  return between(convert(next[-1].mValue), convert(next->mValue), part);
}

Affine local_at(const aiNodeAnim& channel, double time) {
  auto line = [](Vec3 a, Vec3 b, double part) { return a + part * (b - a); };
  auto arc = [](Quat a, Quat b, double part) { return slerp(part, a, b); };
  Vec3 place, scale{1, 1, 1};
  Quat turned;
  if (channel.mNumPositionKeys)
    place = value_at<aiVectorKey, Vec3>(channel.mPositionKeys, channel.mNumPositionKeys, time, vec3_of, line);
  if (channel.mNumRotationKeys)
    turned = value_at<aiQuatKey, Quat>(channel.mRotationKeys, channel.mNumRotationKeys, time, quat_of, arc);
  if (channel.mNumScalingKeys)
    scale = value_at<aiVectorKey, Vec3>(channel.mScalingKeys, channel.mNumScalingKeys, time, vec3_of, line);
  return affine(place, turned, scale);
}

// First and last key, and the number of keys of the fullest channel, in frames.
struct Span {
  double first = 0, last = 0;
  std::size_t most = 0;
};
Span span_of(const aiAnimation& clip) {
  Span span{1e300, -1e300, 0};
  auto see = [&](const auto* keys, unsigned count) {
    if (count == 0) return;
    span.first = std::min(span.first, keys[0].mTime);
    span.last = std::max(span.last, keys[count - 1].mTime);
    span.most = std::max<std::size_t>(span.most, count);
  };
  for (unsigned i = 0; i < clip.mNumChannels; ++i) {
    const aiNodeAnim& channel = *clip.mChannels[i];
    see(channel.mPositionKeys, channel.mNumPositionKeys);
    see(channel.mRotationKeys, channel.mNumRotationKeys);
    see(channel.mScalingKeys, channel.mNumScalingKeys);
  }
  return span.most ? span : Span{};
}

class Builder {
 public:
  Builder(const aiScene& scene, Work& work) : scene_(scene), work_(work) {}

  FbxScene build() {
    add_nodes(*scene_.mRootNode, -1, {});
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) add_clip(*scene_.mAnimations[i], i);
    for (std::size_t node = 0; node < chains_.size(); ++node)
      for (const aiNode* link : chains_[node])
        for (unsigned k = 0; k < link->mNumMeshes; ++k)
          add_mesh(*scene_.mMeshes[link->mMeshes[k]], static_cast<int>(node));
    if (const aiMetadata* told = scene_.mMetaData) read_settings(*told);
    return std::move(out_);
  }

 private:
  void add_nodes(const aiNode& node, int parent, std::vector<const aiNode*> chain) {
    chain.push_back(&node);
    if (!is_helper(node)) {
      FbxScene::Node merged{node.mName.C_Str(), parent, {}};
      for (const aiNode* link : chain) merged.local = merged.local * affine_of(link->mTransformation);
      parent = static_cast<int>(out_.nodes.size());
      out_.nodes.push_back(std::move(merged));
      named_.emplace(node.mName.C_Str(), parent);
      chains_.push_back(std::move(chain));
      chain.clear();
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_nodes(*node.mChildren[i], parent, chain);
  }

  void add_clip(const aiAnimation& animation, unsigned index) {
    std::map<std::string_view, const aiNodeAnim*> channels;
    for (unsigned i = 0; i < animation.mNumChannels; ++i)
      channels[animation.mChannels[i]->mNodeName.C_Str()] = animation.mChannels[i];
    const Span span = span_of(animation);
    FbxScene::Clip clip;
    clip.name = animation.mName.length ? animation.mName.C_Str() : std::to_string(index);
    if (animation.mTicksPerSecond > 0 && out_.rate == 0) out_.rate = animation.mTicksPerSecond;
    // A tick is a frame.
    if (!(span.last - span.first < 1e7)) throw Failure(error("bad-fbx", "a clip is too long"));
    clip.frames = static_cast<std::size_t>(std::floor(span.last - span.first + 1e-3)) + 1;
    clip.sparse = 2 * span.most < clip.frames;
    for (std::size_t node = 0; node < chains_.size(); ++node) {
      work_.check();
      std::vector<std::pair<const aiNode*, const aiNodeAnim*>> links;
      bool moves = false;
      for (const aiNode* link : chains_[node]) {
        const auto found = channels.find(link->mName.C_Str());
        links.emplace_back(link, found == channels.end() ? nullptr : found->second);
        moves = moves || links.back().second;
      }
      if (!moves) continue;
      // Where Assimp gives the node itself a channel, that is its whole transform, pre-rotation and all: the
      // links before it hold the same once more.
      if (links.back().second) links.erase(links.begin(), links.end() - 1);
      FbxScene::Track track{static_cast<int>(node), {}};
      for (std::size_t t = 0; t < clip.frames; ++t) {
        Affine local;
        for (const auto& [link, channel] : links)
          local = local * (channel ? local_at(*channel, span.first + static_cast<double>(t))
                                   : affine_of(link->mTransformation));
        track.local.push_back(local);
      }
      clip.tracks.push_back(std::move(track));
    }
    out_.clips.push_back(std::move(clip));
  }

  void add_mesh(const aiMesh& from, int node) {
    FbxScene::Mesh mesh{node, {}, {}};
    MeshPart& part = mesh.part;
    part.name = from.mName.length ? from.mName.C_Str() : out_.nodes[static_cast<std::size_t>(node)].name;
    auto put = [](std::vector<float>& out, const aiVector3D* values, unsigned count, unsigned width) {
      for (unsigned i = 0; values && i < count; ++i)
        for (unsigned k = 0; k < width; ++k) out.push_back(values[i][k]);
    };
    put(part.positions, from.mVertices, from.mNumVertices, 3);
    put(part.normals, from.mNormals, from.mNumVertices, 3);
    for (std::size_t i = 0; i + 2 < part.normals.size(); i += 3)  // glTF's are of length 1
      normalise(&part.normals[i]);
    put(part.texcoords, from.mTextureCoords[0], from.mNumVertices, 2);
    for (std::size_t i = 1; i < part.texcoords.size(); i += 2) part.texcoords[i] = 1 - part.texcoords[i];
    for (unsigned f = 0; f < from.mNumFaces; ++f)
      if (from.mFaces[f].mNumIndices == 3)
        part.triangles.insert(part.triangles.end(), from.mFaces[f].mIndices, from.mFaces[f].mIndices + 3);
    if (part.triangles.empty()) return;
    add_bones(from, mesh);
    out_.meshes.push_back(std::move(mesh));
    work_.check();
  }

  static void normalise(float* v) {
    const Vec3 unit = normalized(Vec3{v[0], v[1], v[2]});
    const bool none = unit == Vec3{};
    v[0] = static_cast<float>(unit.x);
    v[1] = none ? 1 : static_cast<float>(unit.y);
    v[2] = static_cast<float>(unit.z);
  }

  void add_bones(const aiMesh& from, FbxScene::Mesh& mesh) {
    std::vector<std::vector<std::pair<std::uint32_t, float>>> weights(from.mNumVertices);
    for (unsigned b = 0; b < from.mNumBones; ++b) {
      const aiBone& bone = *from.mBones[b];
      const auto node = named_.find(bone.mName.C_Str());
      if (node == named_.end()) continue;
      const auto index = static_cast<std::uint32_t>(mesh.bones.size());
      mesh.bones.push_back({node->second, affine_of(bone.mOffsetMatrix)});
      for (unsigned w = 0; w < bone.mNumWeights; ++w)
        if (bone.mWeights[w].mVertexId < from.mNumVertices && bone.mWeights[w].mWeight > 0)
          weights[bone.mWeights[w].mVertexId].emplace_back(index, bone.mWeights[w].mWeight);
    }
    if (mesh.bones.empty()) return;
    std::size_t most = 1;
    for (const auto& one : weights) most = std::max(most, one.size());
    const std::size_t width = (most + 3) / 4 * 4;
    mesh.part.influences = static_cast<int>(width);
    for (const auto& one : weights) {
      for (std::size_t k = 0; k < width; ++k) {
        mesh.part.joints.push_back(k < one.size() ? one[k].first : 0);
        mesh.part.weights.push_back(k < one.size() ? one[k].second : 0);
      }
      // A vertex that no bone holds rides on the first.
      if (one.empty()) mesh.part.weights[mesh.part.weights.size() - width] = 1;
    }
  }

  void read_settings(const aiMetadata& told) {
    float unit = 0;
    // The plainest decimal that rounds to it: 2.54.
    if (told.Get("UnitScaleFactor", unit) && unit > 0 && std::isfinite(unit))
      whole_number_text(fmt::format("{}", unit), out_.centimetres);
    const char* const names[3][2] = {
        {"CoordAxis", "CoordAxisSign"}, {"UpAxis", "UpAxisSign"}, {"FrontAxis", "FrontAxisSign"}};
    int axes[3] = {0, 1, 2}, signs[3] = {1, 1, 1};
    for (int i = 0; i < 3; ++i) {
      std::int32_t axis = axes[i], sign = 1;
      if (told.Get(names[i][0], axis) && axis >= 0 && axis < 3) axes[i] = axis;
      if (told.Get(names[i][1], sign) && sign < 0) signs[i] = -1;
    }
    if (axes[0] + axes[1] + axes[2] != 3 || axes[0] == axes[1] || axes[1] == axes[2]) return;
    std::copy(axes, axes + 3, out_.axes);
    std::copy(signs, signs + 3, out_.signs);
  }

  const aiScene& scene_;
  Work& work_;
  FbxScene out_;
  std::vector<std::vector<const aiNode*>> chains_;  // of each node
  std::map<std::string, int> named_;
};

}  // namespace

FbxScene fbx_scene(std::string_view bytes, Work& work) {
  Assimp::Importer importer;
  for (const char* left_out : {AI_CONFIG_IMPORT_FBX_READ_MATERIALS, AI_CONFIG_IMPORT_FBX_READ_TEXTURES,
                               AI_CONFIG_IMPORT_FBX_READ_CAMERAS, AI_CONFIG_IMPORT_FBX_READ_LIGHTS,
                               AI_CONFIG_IMPORT_FBX_OPTIMIZE_EMPTY_ANIMATION_CURVES})
    importer.SetPropertyBool(left_out, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  const aiScene* scene = importer.ReadFileFromMemory(
      bytes.data(), bytes.size(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices, "fbx");
  work.check();
  if (!scene || !scene->mRootNode)
    throw Failure(error("bad-fbx", std::string("Assimp can't read the file: ") + importer.GetErrorString())
                      .hinting("write it as FBX 2013 or newer (7.3 to 7.5), or as GLB"));
  return Builder(*scene, work).build();
}

}  // namespace kinegraph
