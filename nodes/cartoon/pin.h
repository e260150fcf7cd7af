// Makes ends of chains pass exactly through given points by bending the chain's curve [Kwon §6, Fig. 10;
// Nealen et al., FiberMesh, 2007].
#pragma once
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct PinnedJoint {
  std::string joint;
  std::size_t start = 0, end = 0;  // frames, half-open
  Vec3 position;                   // world, m
};

struct PinParams {
  std::vector<PinnedJoint> pins;
  double fade = 0.3;  // seconds before and after each pin in which it takes hold and lets go (C²)
};

// In its frames a pinned joint stands at its point; in the fades it goes there by a part of the way, f
// (target − p). Held for one frame only it passes through its point as it would have passed beside it, and in
// the fades its way is shifted by f times that frame's offset d: that adds at most 5.8 d / fade² of
// acceleration. Held for longer it stands still, which takes away its own acceleration; to do so at an offset
// d from where it is adds at most 5.8 d / fade² to that. The chain above it, up to where it branches off,
// follows by bent_chain(): the first joint's place and the chain's direction there stay, its own bends turn
// with it, and else it bends least (a cubic spline, clamped above and free at the pin); several joints of a
// chain may be pinned at once. Where the ways to two pinned joints part, a chain ends too. Chains nearer to
// the root come first: the others hang on what they move. The pinned joint keeps its orientation, what lies
// below rides with it; links change length. `contacts`, where given: each planted point stays at its mean
// place over the plant (joints as contact_joints(); those without a chain are warned about). Throws Failure
// at `pins[i]` ("unknown-joint", "no-chain", "pins-apart", "pins-overlap", "bad-range", "too-many-pins") or
// at the port `contacts`.
Motion pin(const Motion& motion, const PinParams& params, const Contacts* contacts, Work& work);

}  // namespace kinegraph
