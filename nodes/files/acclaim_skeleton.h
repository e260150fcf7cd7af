// An Acclaim skeleton file, .asf.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

struct AcclaimBone {
  std::string name;
  int parent = -1;  // index into AcclaimSkeleton::bones; the root is bone 0
  Vec3 tip;         // direction * length, in the file's unit: from the bone's start to its end (root: zero)
  Quat axis;        // C: the frame in which the bone's angles are given
  // The bone's values in an .amc line, in order: "rx" … "tz", "l".
  std::vector<std::string> dof;
};

struct AcclaimSkeleton {
  std::vector<AcclaimBone> bones;  // [0] is the root; parents before children, in the order of the hierarchy
  Vec3 root_position;              // added to the root's, in the file's unit
  double metres = 0;               // per unit of the file: 0.0254 / `length`; 0 = the file doesn't say
  bool degrees = true;             // of the .asf's own angles, and of an .amc that doesn't say
};

// Takes CRLF, keywords in any case, sections in any order; `limits`, masses and skin are left out. Throws
// Failure with line and column: "not-an-asf", "bad-asf" (an unknown bone in the hierarchy, a second parent, a
// bone twice or outside the hierarchy, a missing length, axis order or direction).
AcclaimSkeleton read_asf(std::string_view text, Work& work);

}  // namespace kinegraph
