// What a motion made of channels says of itself: with whole bones, unit quaternions and the turns taken out
// that its root has about up.
#pragma once
#include "graph/work.h"
#include "nodes/components/channels.h"

namespace kinegraph {

// channels_of(motion_from_channels(channels, base)), full turns of Euler angles counted from the channels'
// own first frame. Angles that come back as they are, but for rounding (1e-12), are not made rotations and
// angles again.
Rows channels_as_shown(const ChannelSpace& space, const Rows& channels, const Motion& base, Work& work);

}  // namespace kinegraph
