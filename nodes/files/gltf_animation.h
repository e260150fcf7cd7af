// A clip of a glTF file as a motion.
#pragma once
#include <memory>

#include "nodes/files/gltf_nodes.h"
#include "nodes/files/read_options.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct GltfClip {
  Motion motion;
  std::vector<MorphTrack> morphs;  // `part` is a node here
};
// The clip that `options.clip` names (empty: the first), sampled from time 0 to its last key: at options.fps,
// else at `rate` (0 = not known), else at the lowest whole rate from 24 to 240 frames a second on which all
// keys lie, else at 60 ("resampled" tells). STEP, LINEAR and CUBICSPLINE as glTF defines them; joints without
// keys at their node's transform. Without clips one frame at rest. Throws Failure ("unknown-clip") naming
// those there are, "bad-gltf".
GltfClip gltf_clip(const GltfFile& file, const GltfNodes& nodes, const SourceFacts& facts,
                   const ReadOptions& options, double rate, Work& work);

}  // namespace kinegraph
