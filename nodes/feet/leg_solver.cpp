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

}  // namespace

LegChange solve_leg(Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 new_hip, Vec3 new_ankle, double most,
                    double damping) {
  LegChange change;
  const double thigh = norm(knee - hip), shank = norm(ankle - knee), length = norm(ankle - hip);
  const double wanted = norm(new_ankle - new_hip);
  if (thigh <= 0 || shank <= 0 || length <= 0 || wanted <= 0) {
    change.residual = norm((new_ankle - new_hip) - (ankle - hip));
    return change;
  }
  const Vec3 along = (ankle - hip) / length;
  const Quat swing = smallest_turn(along, (new_ankle - new_hip) / wanted);
  const Vec3 side = cross(along, knee - hip);
  const double flexion = pi - corner(thigh, shank, length);

  // The part that the knee takes: never to the last hundredth of the leg, where its angle has no slope.
  const double straight = 0.99 * (thigh + shank),
               folded = 1.02 * std::abs(thigh - shank) + 0.05 * (thigh + shank);
  double bent = length + knee_gain(flexion, damping) * (wanted - length);
  bent = length < straight ? std::min(bent, straight) : length;
  bent = length > folded ? std::max(bent, folded) : length;
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
  change.stretch = std::clamp(wanted / bent, 1 - most, 1 + most);
  change.residual = std::abs(wanted - change.stretch * bent);
  return change;
}

}  // namespace kinegraph
