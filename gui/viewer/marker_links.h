// Lines between markers that belong together, for points that come without any, as those of C3D, TRC and
// tables do: a cloud of dots tells little.
#pragma once
#include <utility>
#include <vector>

namespace kinegraph {

struct ShownMotion;

// Pairs of points, the lower first: of each point its nearest ones among those whose distance hardly changes
// through the clip, as on one bone or one piece of skin. None where points fly freely.
std::vector<std::pair<int, int>> steady_links(const ShownMotion& markers);

}  // namespace kinegraph
