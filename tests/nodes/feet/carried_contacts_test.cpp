// The plants of one body taken for another's: when, how high, and above which floor.
#include "nodes/feet/carried_contacts.h"

#include <gtest/gtest.h>

#include <functional>

#include "graph/diagnostic.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/feet/footskate.h"
#include "tests/nodes/feet/walks_and_runs.h"

namespace kinegraph {
namespace {

// The same rotations on other bones; the root's path is `scale` times as large and `lift` metres higher.
Motion on_body(const Motion& motion, const std::function<void(Skeleton&)>& change, double scale,
               double lift) {
  auto skeleton = std::make_shared<Skeleton>(motion.skeleton());
  change(*skeleton);
  std::vector<bool> translates(static_cast<std::size_t>(motion.joints()), false);
  translates[0] = true;
  Motion out(skeleton, nullptr, motion.fps(), motion.frames(), translates);
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    for (int joint = 0; joint < motion.joints(); ++joint)
      out.rotation(joint).set(t, motion.rotation(joint)[t]);
    out.translation(0).set(t, scale * motion.translation(0)[t] + Vec3{0, lift, 0});
  }
  return out;
}
Motion scaled(const Motion& motion, double scale) {
  return on_body(
      motion,
      [&](Skeleton& skeleton) {
        for (Joint& joint : skeleton.joints) joint.offset = scale * joint.offset;
        for (EndSite& end : skeleton.ends) end.offset = scale * end.offset;
      },
      scale, 0);
}
// On soles that are so much thicker under ankle and ball, and on legs a little longer.
Motion in_boots(const Motion& motion, double under_ankle, double under_ball) {
  constexpr double longer = 0.01;
  return on_body(
      motion,
      [&](Skeleton& skeleton) {
        for (const Leg& leg : find_legs(skeleton)) {
          skeleton.joints[leg.ankle].offset.y -= longer;
          skeleton.joints[leg.toe].offset.y -= under_ankle - under_ball;
        }
      },
      1, longer + under_ankle);
}

class CarriedContacts : public testing::Test {
 protected:
  void SetUp() override {
    walk_ = gait_motion("walk");
    Alone work;
    found_ = detect_contacts(walk_, {}, work);
    ASSERT_EQ(found_.points.size(), 4u);
    for (const FootPoint& point : found_.points) ASSERT_GE(point.heights.size(), 2u);
  }
  Contacts carried(const Motion& motion) {
    Alone work;
    Contacts out = carried_contacts(found_, motion, work);
    told_ = work.reported;
    return out;
  }
  Motion walk_;
  Contacts found_;
  std::vector<Diagnostic> told_;
};

TEST_F(CarriedContacts, StayAsTheyAreOnTheBodyTheyWereFoundOn) {
  const Contacts same = carried(drifted(walk_, 0.1, 0));
  EXPECT_EQ(same.floor, found_.floor);
  for (std::size_t k = 0; k < same.points.size(); ++k) {
    EXPECT_EQ(same.points[k].planted, found_.points[k].planted);
    EXPECT_EQ(same.points[k].heights, found_.points[k].heights);
  }
  EXPECT_TRUE(told_.empty());
}

TEST_F(CarriedContacts, ShrinkWithTheBody) {
  const Contacts small = carried(scaled(walk_, 0.5));
  ASSERT_EQ(small.points.size(), found_.points.size());
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_EQ(told_[0].code, "contacts-carried");
  EXPECT_NEAR(small.leg, 0.5 * found_.leg, 1e-9);
  EXPECT_NEAR(small.floor, 0.5 * found_.floor, 0.002);
  for (std::size_t k = 0; k < small.points.size(); ++k) {
    EXPECT_EQ(small.points[k].planted, found_.points[k].planted);
    ASSERT_EQ(small.points[k].heights.size(), found_.points[k].heights.size());
    for (std::size_t i = 0; i < small.points[k].heights.size(); ++i)
      EXPECT_NEAR(small.points[k].heights[i], 0.5 * found_.points[k].heights[i], 0.002);
  }
}

// How high ankles are above a flat sole is each rig's own: a floor told by the heels would come up with them,
// and feet that swing would be lifted and turned for it.
TEST_F(CarriedContacts, HaveTheirFloorUnderTheBalls) {
  constexpr double thick = 0.08;
  const Motion boots = in_boots(walk_, thick, 0);
  const Contacts out = carried(boots);
  ASSERT_EQ(told_.size(), 1u) << "or these are taken for the same body";
  EXPECT_NEAR(out.floor, found_.floor, 0.02);
  for (std::size_t k = 0; k < out.points.size(); ++k) {
    const double above = out.points[k].part == "heel" ? thick : 0;
    for (std::size_t i = 0; i < out.points[k].heights.size(); ++i)
      EXPECT_NEAR(out.points[k].heights[i], found_.points[k].heights[i] + above, 0.03) << out.points[k].part;
  }
}

TEST_F(CarriedContacts, RiseWithTheGroundAndWithStepsOnIt) {
  for (FootPoint& point : found_.points) point.heights[0] += 0.1;
  const Motion tall = scaled(walk_, 1.2);
  const Contacts out = carried(tall);
  for (const FootPoint& point : out.points)
    EXPECT_NEAR(point.heights[0] - point.heights[1], 0.12, 0.01) << point.foot << ' ' << point.part;
}

TEST_F(CarriedContacts, OfAnotherLengthAreLeftToBeRefused) {
  found_.frames -= 1;
  EXPECT_EQ(carried(scaled(walk_, 0.5)).points[0].joint_name, found_.points[0].joint_name);
  EXPECT_TRUE(told_.empty());
}

}  // namespace
}  // namespace kinegraph
