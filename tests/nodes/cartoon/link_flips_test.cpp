#include "nodes/cartoon/link_flips.h"

#include <gtest/gtest.h>

#include "nodes/cartoon/link_correction.h"
#include "nodes/cartoon/link_turns.h"
#include "nodes/motion/elementary.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
namespace {

// A chain a–b–c along x, 40 frames.
Motion chain() {
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {{"a", -1, {}, {}}, {"b", 0, {1, 0, 0}, {}}, {"c", 1, {1, 0, 0}, {}}};
  return Motion(skeleton, std::make_shared<SourceFacts>(), 120, 40, {true, false, false});
}

double angle(const WorldMotion& world, std::size_t t) {
  const auto link = [&](std::size_t at) { return world.position(1)[at] - world.position(0)[at]; };
  return turn(smallest_turn(link(t - 1), link(t)));
}

TEST(LinkFlips, TurnALinkRoundInStepsAndCarryWhatLiesBelow) {
  Alone work;
  const Motion motion = chain();
  const WorldMotion world = world_motion(motion);
  WorldMotion moved = world;
  for (std::size_t t = 20; t < 40; ++t) {  // b flips to the other side, with c
    moved.position(1).set(t, {-0.6, 0.1, 0});
    moved.position(2).set(t, {0.2, 0.1, 0});
  }
  const auto lengths = link_lengths(motion.skeleton(), on_parent(motion), world);
  const double most = 30 / degrees_per_radian;
  hold_link_flips(motion.skeleton(), lengths, world, {most, 10, 0.2}, moved, work);
  for (std::size_t t = 1; t < 40; ++t) EXPECT_LE(angle(moved, t), most) << t;
  for (std::size_t t = 20; t < 40; ++t) {
    EXPECT_NEAR(norm(moved.position(1)[t] - moved.position(0)[t]), norm(Vec3{-0.6, 0.1, 0}), 1e-12);
    EXPECT_NEAR(norm((moved.position(2)[t] - moved.position(1)[t]) - Vec3{0.8, 0, 0}), 0, 1e-12);
  }
  EXPECT_LT(norm(moved.position(1)[6] - Vec3{1, 0, 0}), 1e-12);
  EXPECT_LT(norm(moved.position(1)[34] - Vec3{-0.6, 0.1, 0}), 1e-12);
}

TEST(LinkFlips, StartAndEndTheirTurnGently) {
  Alone work;
  const Motion motion = chain();
  const WorldMotion world = world_motion(motion);
  const auto lengths = link_lengths(motion.skeleton(), on_parent(motion), world);
  const double most = 30 / degrees_per_radian;
  const auto hardest = [&](int softening) {
    WorldMotion moved = world;
    for (std::size_t t = 20; t < 40; ++t) moved.position(1).set(t, {-0.6, 0.1, 0});
    hold_link_flips(motion.skeleton(), lengths, world, {most, 10, 0.2, softening}, moved, work);
    double largest = 0;
    for (std::size_t t = 1; t < 40; ++t) {
      EXPECT_LE(angle(moved, t), most) << t;
      if (t > 1) largest = std::max(largest, std::fabs(angle(moved, t) - angle(moved, t - 1)));
    }
    EXPECT_EQ(moved.position(1)[2], world.position(1)[2]);
    return largest;
  };
  EXPECT_LT(hardest(8), 0.5 * hardest(0));
}

TEST(LinkFlips, LeaveShortLinksAndWhatTheInputTurns) {
  Alone work;
  const Motion motion = chain();
  const WorldMotion still = world_motion(motion);
  const auto lengths = link_lengths(motion.skeleton(), on_parent(motion), still);
  const LinkFlipParams params{30 / degrees_per_radian, 10, 0.2};
  const auto same = [](const WorldMotion& a, const WorldMotion& b) {
    for (int j = 0; j < 3; ++j)
      for (std::size_t t = 0; t < 40; ++t)
        if (a.position(j)[t] != b.position(j)[t]) return false;
    return true;
  };
  WorldMotion tiny = still;
  for (std::size_t t = 0; t < 40; ++t) tiny.position(1).set(t, {t < 20 ? 0.1 : -0.1, 0, 0});
  for (std::size_t t = 0; t < 40; ++t) tiny.position(2).set(t, tiny.position(1)[t] + Vec3{1, 0, 0});
  WorldMotion held = tiny;
  hold_link_flips(motion.skeleton(), lengths, still, params, held, work);
  EXPECT_TRUE(same(held, tiny));
  // The input turns by 10° there: ten times that are allowed.
  WorldMotion input = still, fast = still;
  for (std::size_t t = 20; t < 40; ++t) {
    input.position(1).set(t, {cosine(10 / degrees_per_radian), sine(10 / degrees_per_radian), 0});
    fast.position(1).set(t, {cosine(90 / degrees_per_radian), sine(90 / degrees_per_radian), 0});
    fast.position(2).set(t, fast.position(1)[t] + Vec3{1, 0, 0});
  }
  held = fast;
  hold_link_flips(motion.skeleton(), lengths, input, params, held, work);
  EXPECT_TRUE(same(held, fast));
}

}  // namespace
}  // namespace kinegraph
