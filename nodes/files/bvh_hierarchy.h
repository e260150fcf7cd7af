// The HIERARCHY of a BVH and the lines before its numbers, as they stand in the file.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct BvhHierarchy {
  std::vector<std::string> names;  // unique, UTF-8
  std::vector<int> parents;        // before their children
  std::vector<BvhJoint> joints;    // channels spelled "Xposition", "Zrotation"
  struct End {
    int joint;
    Vec3 offset;
  };
  std::vector<End> ends;
  std::size_t channels = 0;       // of all joints
  std::size_t frames = 0;         // as announced
  std::string frame_time;         // as written
  const char* numbers = nullptr;  // where the first line of numbers begins
};

// Takes a byte-order mark, tabs, CRLF, keywords in any case, names with blanks (up to the `{` or the line's
// end), any channels in any order, End Sites anywhere, a joint without channels. Duplicate and empty names
// are made unique, and reported ("duplicate-joint", "empty-name", "not-utf8"). Throws Failure with line and
// column: "several-roots", "not-a-bvh", "bad-hierarchy", "bad-channel", "bad-number", "bad-frames",
// "bad-frame-time", "no-motion-section".
BvhHierarchy read_bvh_hierarchy(std::string_view text, Work& work);

}  // namespace kinegraph
