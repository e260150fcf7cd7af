// When heels and balls of the feet are planted: low, and moving with one even slide. A plant is known by the
// evenness of its movement rather than by standing still, so that skating feet are found as well: the speed
// is measured against the plant's own slide, and slides against what all of them have in common (a drift of
// the whole motion).
#pragma once
#include <string>
#include <vector>

#include "graph/param.h"
#include "graph/work.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct ContactEdit {
  std::string foot;  // "left", "right" or the ankle joint's name
  std::string part;  // "heel", "ball" or "both"
  FrameRange range;
  bool planted = true;
};
struct DetectContactsParams {
  std::string heels, balls;        // joint patterns; "" = found
  double height = 0.04;            // m above the point's usual low (the 10th percentile of its height)
  double speed = 0.23;             // m/s against the plant's own slide, over 1/15 s
  double min_time = 0.1;           // s; shorter plants are dropped
  std::vector<ContactEdit> edits;  // applied in order over what was found
};

// The whole clip is looked at. Throws Failure ("no-feet", "unknown-foot", "bad-range"); tells where it finds
// nothing (info "no-contacts").
Contacts detect_contacts(const Motion& motion, const DetectContactsParams& params, Work& work);

// Whether a path is seen from ground that may still slide under it by some 0.15 m/s.
enum class Ground { firm, sliding };
// Of one point's path, metres: one flag a frame.
std::vector<bool> planted_frames(const std::vector<Vec3>& path, double fps,
                                 const DetectContactsParams& params, Ground ground);

}  // namespace kinegraph
