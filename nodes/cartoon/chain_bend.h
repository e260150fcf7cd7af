// How a displacement of some points of a chain spreads along it.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "nodes/motion/rotation.h"

namespace kinegraph {

// Weights of displacements given at places `given` (ascending, above 0) for the displacement at `wanted`: the
// curve through them that bends least, 0 and level at place 0, free at the last. Beyond the last it stays as
// there. Rows in the order of `wanted`, a column a given place.
std::vector<std::vector<double>> bend_weights(const std::vector<double>& given,
                                              const std::vector<double>& wanted);

// The chain, its points at `places` along it, put through the targets of some of them (`given`, ascending,
// not the first) so that its own bends turn along with it, as Nealen et al. deform curves: in turn the places
// are solved for the present rotations, L(v) = R δ, which is the chain of the turned bends plus the
// displacement of least bending, and the rotation of each point is taken from how its two links have turned.
// The first point and its link's direction stay; what lies beyond the last target moves as it does.
// `weights`: bend_weights() of the given places.
std::vector<Vec3> bent_chain(std::span<const Vec3> chain, std::span<const double> places,
                             const std::vector<std::vector<double>>& weights,
                             std::span<const std::size_t> given, std::span<const Vec3> targets);

}  // namespace kinegraph
