#include "nodes/files/gltf_read.h"

#include "nodes/files/gltf_animation.h"
#include "nodes/files/gltf_file.h"
#include "nodes/files/gltf_mesh.h"
#include "nodes/files/gltf_nodes.h"
#include "nodes/files/length_unit.h"

namespace kinegraph {

GltfContents read_gltf(std::string_view bytes, const std::string& path, const ReadOptions& options,
                       FileAccess& files, Work& work, const GltfOrigin& origin) {
  const GltfFile file = read_gltf_file(bytes, path, files);
  const LengthUnit unit = unit_from_param(options.unit, unit_of_metres(1));
  const GltfNodes nodes = gltf_nodes(file, unit.metres, work);
  SourceFacts facts;
  const LengthUnit told = origin.unit.metres > 0 ? origin.unit : unit;
  facts.format = origin.format;
  facts.unit = told.metres;
  facts.unit_name = told.name;
  facts.up = origin.up;
  GltfClip clip = gltf_clip(file, nodes, facts, options, origin.rate, work);
  GltfContents out{std::move(clip.motion), nullptr, file.companions};
  Character character = gltf_character(file, nodes, unit.metres);
  if (character.parts.empty()) return out;
  // Tracks move a node's mesh: all its parts.
  for (const MorphTrack& track : clip.morphs)
    for (std::size_t part = 0; part < character.parts.size(); ++part)
      if (character.parts[part].source_node == track.part &&
          track.target < static_cast<int>(character.parts[part].morphs.size()))
        character.morph_tracks.push_back({static_cast<int>(part), track.target, track.weights});
  if (!character.morph_tracks.empty()) character.morph_fps = out.motion.fps();
  out.character = std::make_shared<const Character>(std::move(character));
  return out;
}

}  // namespace kinegraph
