// How a displacement of some points of a chain spreads along it.
#pragma once
#include <cstddef>
#include <vector>

namespace kinegraph {

// Weights of displacements given at places `given` (ascending, above 0) for the displacement at `wanted`: the
// curve through them that bends least, 0 and level at place 0, free at the last. Beyond the last it stays as
// there. Rows in the order of `wanted`, a column a given place.
std::vector<std::vector<double>> bend_weights(const std::vector<double>& given,
                                              const std::vector<double>& wanted);

}  // namespace kinegraph
