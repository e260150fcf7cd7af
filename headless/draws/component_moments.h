// Which frames of joined clips a strip of poses shows, so that what a component does is seen.
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/components/components.h"

namespace kinegraph {

// The frame of the joined signals, its segment, and the frame of that.
struct Moment {
  std::size_t frame, segment, own_frame;
  double part;  // where it stands along the strip: the middle of its share, in [0, 1]
};

// About a dozen, evenly: so many that they show most of what the components do. Without frames none.
std::vector<Moment> even_moments(const Components& components);

// The same for one component (from 0): where no moment of a clip comes within a fifth of the component's
// range of the most that it does there in one direction, the nearest moment shows that.
std::vector<Moment> telling_moments(const Components& components, std::vector<Moment> moments,
                                    std::size_t entry);

}  // namespace kinegraph
