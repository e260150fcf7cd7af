// A motion as a few small figures in a row, for the body of its node: found once a value, on the thread that
// evaluates, and drawn as lines.
#pragma once
#include <QLineF>
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

struct Still {
  enum class Side : unsigned char { middle, left, right };
  struct Limb {
    QLineF line;  // y up from the floor; a body's height is 1
    Side side = Side::middle;
    int figure = 0;  // from the left
  };
  std::vector<Limb> limbs;
  int figures = 0;
  double step = 0.62;  // from one figure to the next
  double height = 1;   // of the highest figure
};

// `figures` poses, evenly over the clip, seen from the side they walk along. Empty where there is nothing to
// see.
Still make_still(const Motion& motion, int figures);

}  // namespace kinegraph
