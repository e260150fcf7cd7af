// Changes that are known in some frames, carried smoothly through the others.
#pragma once
#include <vector>

#include "nodes/motion/rotation.h"

namespace kinegraph {

// Fills the frames that aren't known: least Σ ‖second difference‖² + (2 / blend)⁴ ‖change‖² (per second), so
// that the change leaves the known frames with their value and speed and dies away within about `blend`
// seconds. A single known frame has no speed, and speed that would carry the change further than its own size
// or `carried`, whichever is larger, is cut down to that. No frame known: zero.
void fill_smoothly(std::vector<Vec3>& change, const std::vector<bool>& known, double fps, double blend,
                   double carried);

// A rise that is at least about `need` in each frame and zero in the `fixed` ones: least Σ (second
// difference)²
// + (2 / blend)⁴ rise² + (1 / 0.02 s)⁴ max(0, need - rise)², so that it doesn't jerk where the need does.
std::vector<double> rise_smoothly(const std::vector<double>& need, const std::vector<bool>& fixed, double fps,
                                  double blend);

}  // namespace kinegraph
