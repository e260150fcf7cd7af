// The smooth curves of motion warping: through given values at given frames, nowhere a jump in value or
// slope, nor in curvature but where they come to rest.
#pragma once
#include <cstddef>
#include <map>
#include <vector>

#include "nodes/motion/rotation.h"

namespace kinegraph {

// Values at frames [0, frames) of the C² cubic spline through `knots` (frame → value, at least one). It is 0
// at the first and last frame unless they have knots, and level at both. Between two neighbouring knots that
// are 0 it rests: what lies beyond a knot of 0 isn't swung to the other side by what lies before it.
std::vector<Vec3> displacement_curve(const std::map<std::size_t, Vec3>& knots, std::size_t frames);

}  // namespace kinegraph
