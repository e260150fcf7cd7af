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

// The frames whose pose, the rotations of all joints but the root, is not bit for bit that of the frame
// before: all, but for a motion that TimeWarp has laid on a longer clock. All where nothing moves.
std::vector<std::size_t> frames_shown(const Motion& motion);

// What DetectContacts finds by its defaults. A motion that holds frames is looked at without them, since its
// feet jerk while its root goes on; frames held are planted as the one they repeat. Reports nothing.
Contacts plants_of(const Motion& motion, Work& work);

// The factor for a motion whose frames are held and left out, whose root therefore doesn't fit its feet frame
// by frame: how much longer the ways of low feet relative to the root have become from `before` to `after`,
// Σ b·b′ / Σ b·b, b being the way from the first to the last frame of each stretch in which a point of
// `contacts` (planted or not) is within 4 cm of its usual low. A whole stretch doesn't mind which of its
// frames are held or left out, and what the foot does there and back cancels: on the pairs of Wu's Table 1 it
// is within 10 % of what the plants ask for once the warp is undone, a sum over single frames within 29 %. As
// long as the feet of `before` stood still in their own time, so will those of `after`. Both motions have the
// same frames and headings. Nothing where nothing moves.
std::optional<double> sweep_factor(const Motion& before, const Motion& after, const Contacts& contacts,
                                   const std::vector<bool>& counted, Work& work);

}  // namespace kinegraph
