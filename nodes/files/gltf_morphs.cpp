#include "nodes/files/gltf_morphs.h"

#include <algorithm>
#include <map>
#include <utility>

namespace kinegraph {

namespace {

// A target's weights over all frames; 0 is among them, as the mesh stands there at rest.
struct Bounds {
  double low = 0, high = 0;
  bool fit() const { return low >= 0 && high <= 1; }
};

// Primitives of one mesh share its weights, so they are split alike.
std::pair<int, int> shared_target(const Character& character, int part, int target) {
  const int mesh = character.parts[part].source_mesh;
  return {mesh >= 0 ? mesh : -1 - part, target};
}

std::vector<float> times(std::vector<float> values, double factor) {
  for (float& value : values) value = static_cast<float>(factor * value);
  return values;
}

std::vector<double> one_way(const std::vector<double>& weights, double largest) {
  std::vector<double> out;
  out.reserve(weights.size());
  for (double weight : weights) out.push_back(std::max(0.0, weight / largest));
  return out;
}

}  // namespace

std::vector<std::size_t> source_targets(const Character& character, const Json& root) {
  std::vector<std::size_t> had(character.parts.size());
  for (std::size_t p = 0; p < had.size(); ++p) {
    const MeshPart& part = character.parts[p];
    if (part.source_mesh < 0) continue;
    const Json& mesh = root.find("meshes")->array()[static_cast<std::size_t>(part.source_mesh)];
    const Json& primitive = mesh.find("primitives")->array()[static_cast<std::size_t>(part.source_primitive)];
    if (const Json* targets = primitive.find("targets"); targets && targets->is_array())
      had[p] = targets->array().size();
  }
  return had;
}

Character with_weights_from_0_to_1(const Character& character, const std::vector<std::size_t>& had) {
  std::map<std::pair<int, int>, Bounds> bounds;
  for (const MorphTrack& track : character.morph_tracks) {
    if (static_cast<std::size_t>(track.target) < had[track.part]) continue;
    Bounds& of = bounds[shared_target(character, track.part, track.target)];
    for (double weight : track.weights) {
      of.low = std::min(of.low, weight);
      of.high = std::max(of.high, weight);
    }
  }
  Character out = character;
  if (std::all_of(bounds.begin(), bounds.end(), [](const auto& one) { return one.second.fit(); })) return out;
  out.morph_tracks.clear();
  for (int p = 0; p < static_cast<int>(out.parts.size()); ++p) {
    const std::vector<MorphTarget> were = std::exchange(out.parts[p].morphs, {});
    for (int k = 0; k < static_cast<int>(were.size()); ++k) {
      const auto found = bounds.find(shared_target(character, p, k));
      const Bounds of = found == bounds.end() ? Bounds{} : found->second;
      const MorphTarget& was = were[k];
      auto add = [&](MorphTarget target, auto weights_of) {
        for (const MorphTrack& track : character.morph_tracks)
          if (track.part == p && track.target == k)
            out.morph_tracks.push_back(
                {p, static_cast<int>(out.parts[p].morphs.size()), weights_of(track.weights)});
        out.parts[p].morphs.push_back(std::move(target));
      };
      auto add_way = [&](const char* sign, double largest) {
        add({was.name + sign, times(was.positions, largest), times(was.normals, largest)},
            [&](const std::vector<double>& weights) { return one_way(weights, largest); });
      };
      if (of.fit())
        add(was, [](const std::vector<double>& weights) { return weights; });
      else {
        if (of.high > 0) add_way("", of.high);
        if (of.low < 0) add_way("-", of.low);
      }
    }
  }
  return out;
}

}  // namespace kinegraph
