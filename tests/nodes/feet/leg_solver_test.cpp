#include "nodes/feet/leg_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace kinegraph {
namespace {

const Vec3 hip{0, 0.9, 0}, ankle{0, 0.1, 0.1};
Vec3 knee_bent_by(double ahead) {
  return {0, 0.5, 0.05 + ahead};
}

Vec3 reached(Vec3 knee, Vec3 new_hip, const LegChange& change) {
  return new_hip + change.stretch * (rotate(change.thigh, knee - hip) + rotate(change.shank, ankle - knee));
}
double knee_angle(Vec3 thigh, Vec3 shank) {
  return std::acos(dot(thigh, shank) / norm(thigh) / norm(shank));
}

TEST(LegSolver, PutsTheAnkleOnItsPlace) {
  for (double ahead : {0.001, 0.05, 0.2}) {
    const Vec3 knee = knee_bent_by(ahead), new_hip = hip + Vec3{0.01, -0.01, 0.02},
               place = ankle + Vec3{0.02, 0.01, -0.03};
    const LegChange change = solve_leg(hip, knee, ankle, new_hip, place, 1.0);
    EXPECT_NEAR(norm(reached(knee, new_hip, change) - place), 0, 1e-9) << ahead;
  }
}

TEST(LegSolver, KeepsAStraightKneesAngleAndBendsABentOne) {
  const Vec3 place = ankle + Vec3{0, 0.01, 0};
  for (auto [ahead, bends] : {std::pair{0.05, false}, std::pair{0.5, true}}) {
    const Vec3 knee = knee_bent_by(ahead);
    const LegChange change = solve_leg(hip, knee, ankle, hip, place, 1.5);
    const double before = knee_angle(knee - hip, ankle - knee);
    const double after = knee_angle(rotate(change.thigh, knee - hip), rotate(change.shank, ankle - knee));
    EXPECT_EQ(std::abs(after - before) > 0.003, bends) << ahead;
    EXPECT_EQ(std::abs(change.stretch - 1) > 0.003, !bends) << ahead;
  }
}

TEST(LegSolver, ChangesNothingWhereNothingMoves) {
  const LegChange change = solve_leg(hip, knee_bent_by(0.1), ankle, hip, ankle, 1.5);
  EXPECT_NEAR(turn(change.thigh), 0, 1e-7);
  EXPECT_NEAR(turn(change.shank), 0, 1e-7);
  EXPECT_NEAR(change.stretch, 1, 1e-12);
}

}  // namespace
}  // namespace kinegraph
