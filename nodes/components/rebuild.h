// From signals back to poses [Shapiro eq. 3, Cao eq. 8]: x = E{x} + P A u.
#pragma once
#include <memory>
#include <vector>

#include "graph/work.h"
#include "nodes/components/components.h"

namespace kinegraph {

// Signals of one segment: k rows, a column a frame of it.
Rows signals_of(const Components& components, const ComponentSegment& segment);

// E{x} + Σ over `entries` (from 0) of (P A)ᵢ uᵢ, of signals of any length. D rows.
Rows channels_from_signals(const Components& components, const Rows& signals,
                           const std::vector<std::size_t>& entries);
Rows channels_from_signals(const Components& components, const Rows& signals);

// u = (P A)⁺ (x - E{x}).
Rows signals_from_channels(const Components& components, const Rows& channels);

// The channels of a segment's own clip, Euler angles shifted by full turns to where the components have them.
Rows channels_of_segment(const Components& components, const ComponentSegment& segment, Work& work);

// Which kinds of clip come out: throws Failure ("no-motion") where the components are of points.
Motion motion_of(const Components& components, const Rows& channels, const ComponentSegment& base,
                 const WayBack& way, Work& work);
Points points_of(const Components& components, const Rows& channels, const ComponentSegment& base,
                 const WayBack& way, Work& work);

}  // namespace kinegraph
