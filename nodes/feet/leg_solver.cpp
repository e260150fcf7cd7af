#include "nodes/feet/leg_solver.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

// [Kovar eq. 10-11] fade the knee's gain from 1 to 0 towards full extension with α(u) = 2u³ − 3u² + 1; here
// over flexion.
double knee_gain(double flexion, double damping) {
  if (damping <= 0) return 1;
  const double u = (flexion - damping / 3) / (damping - damping / 3);
  if (u <= 0) return 0;
  if (u >= 1) return 1;
  return u * u * u * (10 + u * (-15 + 6 * u));
}

// The angle between sides a and b of a triangle whose third side is c.
double corner(double a, double b, double c) {
  return arc_cosine((a * a + b * b - c * c) / (2 * a * b));
}

double flexion_of(double thigh, double shank, double length) {
  return pi - corner(thigh, shank, length);
}

// What the knee makes of the length that is wanted of a leg: never more than 0.99 of thigh and shank, where
// its angle has no slope. A leg that must become much shorter is bent, however straight it was: its knee
// leaves the range where lengths pop.
double bent_length(double thigh, double shank, double length, double wanted, double damping) {
  const double straight = 0.99 * (thigh + shank),
               folded = 1.02 * std::abs(thigh - shank) + 0.05 * (thigh + shank);
  const double shorter = std::max(std::min(wanted, length), std::min(folded, length));
  const double gain = knee_gain(flexion_of(thigh, shank, shorter), damping);
  const double bent = length + gain * (wanted - length);
  if (length >= straight && bent >= length) return length;
  if (length <= folded && bent <= length) return length;
  return std::clamp(bent, std::min(folded, length), std::max(straight, length));
}

}  // namespace

LegReach leg_reach(Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 new_hip, Vec3 new_ankle, double damping) {
  LegReach reach;
  const double thigh = norm(knee - hip), shank = norm(ankle - knee);
  reach.length = reach.bent = norm(ankle - hip);
  const double wanted = norm(new_ankle - new_hip);
  if (thigh <= 0 || shank <= 0 || reach.length <= 0 || wanted <= 0) return reach;
  reach.wanted = wanted;
  reach.along = (new_ankle - new_hip) / wanted;
  reach.bent = bent_length(thigh, shank, reach.length, wanted, damping);
  const double step = 1e-4 * reach.length;
  const double taken = bent_length(thigh, shank, reach.length, wanted + step, damping) -
                       bent_length(thigh, shank, reach.length, wanted - step, damping);
  reach.left_over = std::clamp(1 - taken / (2 * step), 0.0, 1.0);
  return reach;
}

LegChange solve_leg(Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 new_hip, Vec3 new_ankle, double damping) {
  LegChange change;
  const LegReach reach = leg_reach(hip, knee, ankle, new_hip, new_ankle, damping);
  if (reach.wanted <= 0) return change;
  const double thigh = norm(knee - hip), shank = norm(ankle - knee), length = reach.length;
  const Vec3 along = (ankle - hip) / length;
  const Quat swing = smallest_turn(along, reach.along);
  const Vec3 side = cross(along, knee - hip);
  double bent = reach.bent;
  Quat at_hip, at_ankle;
  if (bent != length && norm(side) > 1e-9) {
    const Vec3 axis = normalized(side);
    at_hip = axis_angle(axis, corner(thigh, bent, shank) - corner(thigh, length, shank));
    at_ankle = axis_angle(axis, corner(shank, length, thigh) - corner(shank, bent, thigh));
  } else {
    bent = length;
  }
  change.thigh = swing * at_hip;
  change.shank = swing * at_ankle;
  change.stretch = reach.wanted / bent;
  return change;
}

}  // namespace kinegraph
