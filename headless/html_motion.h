// A motion or points as the page's player wants them (headless/page/player.js).
#pragma once
#include <string>

#include "graph/json.h"
#include "graph/value.h"

namespace kinegraph {

// {"name", "fps", "frames", "frames_of_clip", "points": [name], "body": index, "bones": [[from, to, radius,
// radius]], "sides": [-1 right, 0, 1 left], "origin": [x, y, z], "step", "positions"}: positions are base64
// of two-byte little-endian whole numbers, times `step` metres from `origin`, x y z of every point, frame by
// frame; 65535 is a point that is missing. Of a long clip every second, third, … frame. Null for values of
// other types and without frames.
Json motion_for_page(const Value& value, const std::string& name);

}  // namespace kinegraph
