// How much faster or slower a motion must travel for its planted feet to stand still.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// The factor k on the root's horizontal steps that makes the planted points slide least: with a_t the root's
// step in frame t and b_t the step of a planted point relative to the root, both horizontal, Σ ‖k a_t + b_t‖²
// is least at k = −Σ a·b / Σ a·a, over every point and every frame t in which it is planted as in frame t − 1
// and `counted`. `motion` and `contacts` have the same frames; `counted` empty: every frame. Nothing where no
// frame qualifies or the root stands still.
std::optional<double> travel_factor(const Motion& motion, const Contacts& contacts,
                                    const std::vector<bool>& counted, Work& work);

}  // namespace kinegraph
