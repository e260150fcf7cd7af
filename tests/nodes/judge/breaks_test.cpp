// Flips, jumps and spikes: found where they were put, and nowhere in a clean clip.
#include "nodes/judge/breaks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/gait/gait.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

Motion walk() {
  Alone work;
  GaitParams params;
  params.seconds = 2;
  return make_gait(params, work);
}
int joint(const Motion& motion, const char* name) {
  return motion.skeleton().find(name);
}
void turn_from(Motion& motion, int j, std::size_t first, std::size_t end, double degrees) {
  const auto q = motion.rotation(j);
  for (std::size_t t = first; t < end; ++t)
    q.set(t, axis_angle({1, 0, 0}, degrees / degrees_per_radian) * q[t]);
}

TEST(Breaks, AreNotFoundInACleanWalk) {
  Alone work;
  EXPECT_TRUE(breaks_of(walk(), 0, work).empty());
}

TEST(Breaks, OfRotationsAreToldApart) {
  Alone work;
  Motion motion = walk();
  const int arm = joint(motion, "LeftArm"), head = joint(motion, "Head"), hand = joint(motion, "RightHand");
  turn_from(motion, arm, 50, motion.frames(), 150);  // stays there, half a turn away
  turn_from(motion, head, 80, motion.frames(), 25);  // stays there
  turn_from(motion, hand, 30, 32, 40);               // out and back
  const std::vector<Break> found = breaks_of(motion, 0, work);
  ASSERT_EQ(found.size(), 3u);
  for (const Break& one : found) {
    EXPECT_TRUE(one.turns);
    if (one.joint == arm) {
      EXPECT_EQ(one.kind, Break::Kind::flip);
      EXPECT_EQ(one.frame, 50u);
      EXPECT_NEAR(one.size * degrees_per_radian, 150, 2);
    } else if (one.joint == head) {
      EXPECT_EQ(one.kind, Break::Kind::jump);
      EXPECT_EQ(one.frame, 80u);
    } else {
      EXPECT_EQ(one.joint, hand);
      EXPECT_EQ(one.kind, Break::Kind::spike);
      EXPECT_EQ(one.frame, 30u);
      EXPECT_EQ(one.frames, 2u);
    }
  }
}

TEST(Breaks, OfARestPoseInFrontAreLeftOutWhereToldTo) {
  Alone work;
  Motion motion = walk();
  turn_from(motion, joint(motion, "LeftArm"), 0, 1, 80);
  EXPECT_EQ(breaks_of(motion, 0, work).size(), 1u);
  EXPECT_TRUE(breaks_of(motion, 1, work).empty());
}

TEST(Breaks, OfTheRootsPlaceAreInMetres) {
  Alone work;
  Motion motion = walk();
  const auto place = motion.translation(0);
  for (std::size_t t = 100; t < motion.frames(); ++t) place.set(t, place[t] + Vec3{0, 0, 0.5});
  const std::vector<Break> found = breaks_of(motion, 0, work);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].turns);
  EXPECT_NEAR(found[0].size, 0.5, 0.05);
}

TEST(Breaks, OfMarkersAreFoundBesideGapsButNotAcrossThem) {
  Alone work;
  Points points({"a", "b"}, 100, 60);
  for (std::size_t t = 0; t < 60; ++t) {
    points.track(0).set(t, {0.001 * double(t), 1.7, 0});
    points.track(1).set(t, {0.001 * double(t), t < 30 ? 0 : 0.4, 0});
  }
  points.set_missing(1, 29);  // what happens in a gap can't be seen
  EXPECT_TRUE(breaks_of(points, work).empty());
  points.track(0).set(20, {0.02, 1.9, 0});
  const std::vector<Break> found = breaks_of(points, work);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, Break::Kind::spike);
  EXPECT_EQ(found[0].frame, 20u);
  EXPECT_NEAR(found[0].size, 0.2, 1e-4);
  EXPECT_NEAR(extent_of(points), 1.9, 1e-9);
}

}  // namespace
}  // namespace kinegraph
