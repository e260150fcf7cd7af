// The curve through the joints of a group [Kwon §5.2]: a Bézier curve that passes through all of them.
#pragma once
#include <span>
#include <vector>

namespace kinegraph {

// Weights of the joints for points of the curve: rows in the order of `wanted`, a column a joint. They depend
// only on the rest lengths, so a clip's sub-joints are one small constant matrix times its joints.
struct CurveWeights {
  std::size_t joints = 0;
  std::vector<double> rows;  // wanted.size() * joints
};

// A point asked for: `part` of the way, in [0, 1), along the link from joint `link` to the next.
struct CurvePoint {
  std::size_t link = 0;
  double part = 0;
};

// `lengths`: of the rest links, one less than joints, any unit. The Bézier of degree n through n + 1 joints
// with chord-length parameters u_i = Σ_{j≤i} |v_j| / Σ |v_j|; a point's parameter is u_k + part (u_{k+1} −
// u_k). A link under 2 % of the whole is merged: its lower joint isn't a knot. Over 5 knots the curve is
// split into pieces of at most 4, which share a knot and there the direction of the parabola through it and
// its neighbours (C1), since one curve of high degree swings away from the limb.
CurveWeights curve_weights(std::span<const double> lengths, std::span<const CurvePoint> wanted);

}  // namespace kinegraph
