// What a component does to points that have no names worth telling, such as particles: which of them it
// moves, by where they usually are, and which way.
#pragma once
#include <cstddef>
#include <string>

#include "nodes/components/components.h"

namespace kinegraph {

// Points without links and more of them than anyone reads the names of (64): told apart by place.
bool is_cloud(const Components& components);

// "42 % of the points, the upper outer ones, mostly up and down". The share is of the fewest points
// that hold four fifths of all that is moved (squares); the place where they lie by more than a quarter of
// the cloud's spread above or below its mean, or farther from or nearer to its vertical axis; the direction
// the one that holds at least three fifths of the movement: up and down, in and out (from that axis), or
// round it.
std::string cloud_caption(const Components& components, std::size_t entry);

}  // namespace kinegraph
