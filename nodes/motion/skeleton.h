// Joints in a tree. Lengths in metres, Y up, right-handed.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/motion/rotation.h"

namespace kinegraph {

struct Joint {
  std::string name;
  int parent = -1;  // index; always smaller than the joint's own; -1 = root
  Vec3 offset;      // rest translation in the parent's frame (of the root: in the frame of Skeleton::above)
  Quat rest;        // rest rotation; identity in BVH and ASF
};

// A point that rides on a joint and has no channels: BVH's End Site, the tip of an ASF bone.
struct EndSite {
  int joint = 0;
  Vec3 offset;
  std::string name;  // "" in BVH
};

struct Skeleton {
  std::vector<Joint> joints;  // parents before children; joints[0] is the root
  std::vector<EndSite> ends;
  // What stands fixed above the root (glTF armature nodes): world = above * local.
  Quat above;
  Vec3 above_offset;
  double above_scale = 1;

  int size() const { return static_cast<int>(joints.size()); }
  int find(std::string_view name) const;  // -1: none
  std::vector<int> children(int joint) const;
  bool is_below(int joint, int ancestor) const;  // true also for the joint itself
  double link_length(int joint) const { return norm(joints[joint].offset); }
};

struct RestPose {
  std::vector<Vec3> positions;     // world, metres
  std::vector<Quat> orientations;  // world
  std::vector<Vec3> ends;          // world, of Skeleton::ends
};
RestPose rest_pose(const Skeleton& skeleton);  // the root at its offset
double rest_height(const Skeleton& skeleton);  // extent along up of the rest pose, End Sites included

// The feet, found by name, else by geometry (the two lowest chains). -1: none.
struct Leg {
  int hip = -1, knee = -1, ankle = -1, toe = -1;  // LeftUpLeg, LeftLeg, LeftFoot, LeftToeBase
  std::optional<Vec3> toe_tip;  // the End Site below the toe (or ankle), in that joint's frame
  bool left = true;
};
std::vector<Leg> find_legs(const Skeleton& skeleton);  // left first; empty when there are none
double leg_length(const Skeleton& skeleton);  // hip to ankle along the links, mean of both; 0 without legs

// Partners of two skeletons: for each joint of `to` the joint of `from`, or -1. `map` entries are "FROM=TO";
// empty: equal names, then the built-in table CMU AMC <-> CMU BVH. Throws Failure ("unknown-joint",
// "bad-map") naming the entry.
std::vector<int> partners(const Skeleton& from, const Skeleton& to, const std::vector<std::string>& map);

}  // namespace kinegraph
