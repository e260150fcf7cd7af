// Footskate cleanup [Kovar, Schreiner, Gleicher 2002], as smooth changes over the whole clip: planted points
// are held on their places, the root helps, legs stretch by a little, and the changes fade through the free
// frames.
#pragma once
#include <optional>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct FootskateParams {
  double blend = 0.3;            // s over which a change dies away in free frames
  double stretch = 0.05;         // most change of a planted leg's length, as a part of it; 0 = rigid legs
  double knee_damping = 90;      // degrees of flexion from which on the knee bends freely
  std::optional<double> floor;   // world height for all plants, m; none = each plant keeps its own
  double root_smoothing = 0.08;  // s
};

struct FootskateResult {
  Motion motion;                // knees and ankles translate where legs stretch
  double largest_residual = 0;  // m, in planted frames, that `stretch` did not allow
  std::size_t residual_frame = 0;
  int residual_joint = -1;
  // |length / original - 1|; also while a foot swings, where it may pass `stretch`.
  double largest_stretch = 0;
  double largest_root_move = 0;  // m
};

// `weights`: how much of the change is made at each frame, 0 to 1 (range, fade, amount). Where the residual
// exceeds 1 mm it is reported as a warning ("plants-out-of-reach"). Throws Failure ("contacts-mismatch",
// "no-feet").
FootskateResult clean_footskate(const Motion& motion, const Contacts& contacts, const FootskateParams& params,
                                const std::vector<double>& weights, Work& work);

}  // namespace kinegraph
