// What a person wants to know of a motion file before using it: what `kinegraph info` prints.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "graph/json.h"
#include "nodes/files/gltf_inventory.h"
#include "nodes/files/motion_file.h"
#include "nodes/judge/breaks.h"
#include "nodes/motion/contacts.h"

namespace kinegraph {

struct MotionFacts {
  double rest_height = 0;   // m, End Sites included
  double first_height = 0;  // m, of the joints in the first frame, a T-pose left out
  double leg_length = 0;    // m; 0 = no legs were found
  double travel = 0;        // m, how far the hips, else the root, go over the ground
  bool rest_frame = false;  // frame 0 looks like a T-pose
  // Each joint's channels in the file, in order, of a BVH ("Zrotation") and of Acclaim's dof ("rz"); else
  // empty.
  std::vector<std::vector<std::string>> layout;
  // The same, like ones together: "6 Xposition … Xrotation: Hips", "3 rx ry rz: 14 joints", "0: lhipjoint".
  std::vector<std::string> channels;
  std::vector<std::string> translating;  // joints besides the root whose place varies
  std::optional<Contacts> contacts;      // DetectContacts' defaults; nothing where there are no feet
};

struct PointsFacts {
  double height = 0;              // m, largest extent along up in any one frame
  std::vector<std::size_t> gaps;  // missing samples of each label
  std::size_t missing = 0;        // of all
  std::size_t short_gaps = 0;     // of those, in gaps that Load's default max_gap fills
  std::size_t longest = 0;        // frames of the longest gap, its first frame and label
  std::size_t longest_at = 0;
  int longest_label = -1;
  std::size_t whole_frames = 0;  // frames in which nothing is missing
};

struct FileFacts {
  std::string format, ports;
  std::size_t frames = 0;
  double fps = 0, seconds = 0;
  double unit = 1;
  std::string unit_name, unit_from;  // "cmu", "found by its height"
  std::string up;                    // "Y" or "Z"
  std::optional<MotionFacts> motion;
  std::optional<PointsFacts> points;
  std::optional<GltfInventory> gltf;  // of an FBX its skins and meshes alone
  std::vector<Break> breaks;
  std::size_t non_finite = 0;
  Diagnostics told;  // what reading reported, then what other programs will stumble over
};

// `told`: what reading reported, with max_gap 0, so that gaps are counted as the file has them.
FileFacts facts_of(const MotionFile& file, const std::string& path, FileAccess& files, Diagnostics told,
                   Work& work);

// The skeleton as a tree, a joint a line, with offsets in metres.
std::string skeleton_tree(const Skeleton& skeleton);
Json facts_json(const MotionFile& file, const FileFacts& facts, const std::string& shown_path);
// As text for a person.
std::string facts_text(const MotionFile& file, const FileFacts& facts, const std::string& shown_path);

}  // namespace kinegraph
