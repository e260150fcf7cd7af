// World positions of every node and frame of a motion file as Assimp reads it, in the form of the scripts
// that ask Blender and three.js the same, for tests/clients/run:
//
//   assimp_positions FILE OUT.json [FPS]
//
// OUT.json: {"joints": [names of all nodes], "frames": n, "fps": f, "positions": [frame][node][x, y, z]}.
// FPS: of the frames asked for; without it the file's own ticks (BVH has a tick a frame).
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

// The value of a channel's keys at a time in ticks; `blend(a, b, part)`.
template <class Key, class Blend>
auto value_at(const Key* keys, unsigned count, double time, Blend blend) {
  unsigned next = 0;
  while (next < count && keys[next].mTime < time) ++next;
  if (next == 0) return keys[0].mValue;
  if (next == count) return keys[count - 1].mValue;
  const Key &a = keys[next - 1], &b = keys[next];
  return blend(a.mValue, b.mValue, static_cast<float>((time - a.mTime) / (b.mTime - a.mTime)));
}

aiMatrix4x4 local_at(const aiNode& node, const aiNodeAnim* channel, double time) {
  if (!channel) return node.mTransformation;
  auto line = [](const aiVector3D& a, const aiVector3D& b, float part) { return a + (b - a) * part; };
  auto arc = [](const aiQuaternion& a, const aiQuaternion& b, float part) {
    aiQuaternion between;
    aiQuaternion::Interpolate(between, a, b, part);
    return between;
  };
  return {value_at(channel->mScalingKeys, channel->mNumScalingKeys, time, line),
          value_at(channel->mRotationKeys, channel->mNumRotationKeys, time, arc),
          value_at(channel->mPositionKeys, channel->mNumPositionKeys, time, line)};
}

struct Nodes {
  std::map<std::string, const aiNodeAnim*> channels;
  double time = 0;
  nlohmann::json positions;
  std::vector<std::string> names;

  void visit(const aiNode& node, const aiMatrix4x4& above) {
    const auto found = channels.find(node.mName.C_Str());
    const aiMatrix4x4 world = above * local_at(node, found == channels.end() ? nullptr : found->second, time);
    names.emplace_back(node.mName.C_Str());
    positions.push_back({world.a4, world.b4, world.c4});
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], world);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: assimp_positions FILE OUT.json [FPS]\n";
    return 2;
  }
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(argv[1], 0);
  if (!scene || !scene->mRootNode || scene->mNumAnimations == 0) {
    std::cerr << argv[1] << ": " << (scene ? "no animation" : importer.GetErrorString()) << "\n";
    return 1;
  }
  const aiAnimation& clip = *scene->mAnimations[0];
  const double ticks = clip.mTicksPerSecond > 0 ? clip.mTicksPerSecond : 1;
  const double fps = argc > 3 ? std::atof(argv[3]) : ticks;
  Nodes nodes;
  double last = 0;
  for (unsigned i = 0; i < clip.mNumChannels; ++i) {
    const aiNodeAnim* channel = clip.mChannels[i];
    nodes.channels[channel->mNodeName.C_Str()] = channel;
    last = std::max({last, channel->mRotationKeys[channel->mNumRotationKeys - 1].mTime,
                     channel->mPositionKeys[channel->mNumPositionKeys - 1].mTime});
  }
  const auto frames = static_cast<std::size_t>(std::lround(last / ticks * fps)) + 1;
  auto positions = nlohmann::json::array();
  for (std::size_t frame = 0; frame < frames; ++frame) {
    nodes.time = std::min(static_cast<double>(frame) / fps * ticks, last);
    nodes.names.clear();
    nodes.positions = nlohmann::json::array();
    nodes.visit(*scene->mRootNode, aiMatrix4x4());
    positions.push_back(std::move(nodes.positions));
  }
  std::ofstream(argv[2]) << nlohmann::json{
      {"joints", nodes.names}, {"frames", frames}, {"fps", fps}, {"positions", positions}};
}
