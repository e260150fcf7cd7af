// Several moments of a skeleton in a row, as in a chronophotograph: ground, shadows, the feet's trails,
// contact marks, times below. Rows of several motions share scale, camera and moments, so that before and
// after compare.
#pragma once
#include <string>
#include <vector>

#include "headless/draws/canvas.h"
#include "nodes/motion/character.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct StripRow {
  const Motion* motion = nullptr;
  std::string label;                   // "before"; "" = none
  const Contacts* contacts = nullptr;  // of the same frames, or null
  // Drawn instead of the skeleton's figure, joints matched by name; or null.
  const Character* character = nullptr;
};
struct StripOptions {
  std::string title;
  std::string subtitle;  // "" = what there is to say of the first motion
  double width = 1200;
  int moments = 0;           // 0 = as many as look good
  bool contact_bars = true;  // below a row with contacts: when each part of a foot is planted
};

// A motion that travels is seen from its side; where the moments stand far enough apart they are drawn to
// scale along the path, else they are spread evenly over time. One that stays in place is seen from the
// front, turned a little. Throws Failure ("no-common-joint") for a character of other joints. A motion
// without frames or joints gives a picture that says so.
Canvas draw_strips(const std::vector<StripRow>& rows, const StripOptions& options);

// "277 frames · 120 fps · 2.31 s · 31 joints · travels 3.42 m"
std::string facts_of(const Motion& motion);

}  // namespace kinegraph
