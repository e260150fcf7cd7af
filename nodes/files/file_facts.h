// What a person wants to know of a motion file before using it.
#pragma once
#include <string>
#include <vector>

#include "graph/diagnostic.h"
#include "graph/json.h"
#include "nodes/files/motion_file.h"

namespace kinegraph {

struct MotionFacts {
  std::size_t frames = 0;
  double fps = 0, seconds = 0;
  std::string unit;        // "cmu (0.0564444 m)"
  std::string up;          // "Y" or "Z"
  double rest_height = 0;  // m, End Sites included
  double leg_length = 0;   // m; 0 = no legs were found
  int joints = 0, ends = 0;
  bool rest_frame = false;  // frame 0 looks like a T-pose
  // Channels of a BVH, like ones together: "6 Xposition … Xrotation: Hips", "3 Zrotation …: 30 joints".
  std::vector<std::string> channels;
  // What other programs will stumble over: "three-adds-offset", "assimp-names", "no-end-site".
  Diagnostics for_others;
};
MotionFacts facts_of(const Motion& motion);
// The skeleton as a tree, a joint a line, with offsets in metres.
std::string skeleton_tree(const Skeleton& skeleton);
// All of a file, as `kinegraph info --json` prints it. `told`: what reading reported.
Json facts_json(const MotionFile& file, const std::string& shown_path, const Diagnostics& told);
// As text for a person.
std::string facts_text(const MotionFile& file, const std::string& shown_path, const Diagnostics& told);

}  // namespace kinegraph
