// Frames at which a clip breaks: what a person would see as a pop and a curve editor as a tooth. Found in the
// captured channels themselves (local rotations, the root's place, markers), so that a break is told once, of
// the joint that makes it, and not of all joints below.
#pragma once
#include <cstddef>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"
#include "nodes/motion/points.h"

namespace kinegraph {

struct Break {
  enum class Kind {
    flip,   // a rotation jumps by 90° or more, and stays there
    jump,   // likewise by less, or a place jumps
    spike,  // out and back within three frames
  };
  Kind kind;
  int joint;               // or label
  std::size_t frame;       // the first on the other side
  std::size_t frames = 0;  // of a spike: how long it lasts
  bool turns = true;       // size in radians; else in metres
  double size = 0;
};
const char* name_of(Break::Kind kind);

// A step from one frame to the next breaks where it is 8 times the median of the 16 around it, over 10° or
// 0.01 of the height, and four times each of its neighbours (a jump), or is undone within three frames (a
// spike; then a third of it may remain). In order of joints, rotations first, then frames. Frames [first,
// end).
std::vector<Break> breaks_of(const Motion& motion, std::size_t first, Work& work);
// Of markers; steps from or to a missing sample aren't looked at.
std::vector<Break> breaks_of(const Points& points, Work& work);

// Largest extent of the points in any one frame, along any axis, m.
double extent_of(const Points& points);

}  // namespace kinegraph
