// One leg of a motion as Footskate sees it: where its parts are in the world, frame by frame, and when they
// are planted.
#pragma once
#include <optional>
#include <vector>

#include "nodes/motion/contacts.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

struct FootTrack {
  Leg leg;
  std::vector<Vec3> ankle;  // world, m
  // A heel or ball: seen from the ankle, in world axes, and its planted flags. Empty flags: this foot has
  // none.
  struct Part {
    std::vector<Vec3> from_ankle;
    std::vector<bool> planted;
    std::vector<double> heights;  // FootPoint::heights
    bool planted_at(std::size_t t) const { return !planted.empty() && planted[t]; }
  };
  Part heel, ball;
  std::vector<Vec3> toe_from_ankle, tip_from_ankle;  // toe joint and its End Site; empty = the foot has none
  std::size_t frames() const { return ankle.size(); }
};

// Feet of the contacts, in the skeleton's legs. Throws Failure ("contacts-mismatch") where the contacts are
// of another skeleton or length.
std::vector<FootTrack> foot_tracks(const Skeleton& skeleton, const WorldMotion& world,
                                   const Contacts& contacts);

}  // namespace kinegraph
