// Rotations that stand in no motion, such as the encoded root's ρ, as a track like a joint's.
#pragma once
#include <span>
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

// x of every frame, then y, z and w, each as long as `rotations`.
std::vector<double> as_channels(std::span<const Quat> rotations);
// Views of what as_channels gives.
ConstQuatTrack track_of(const std::vector<double>& channels);
QuatTrack track_of(std::vector<double>& channels);

}  // namespace kinegraph
