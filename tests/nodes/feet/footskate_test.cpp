#include "nodes/feet/footskate.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"
#include "nodes/all_nodes.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/feet/foot_points.h"
#include "tests/nodes/feet/walks_and_runs.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
namespace {

FootskateResult cleaned(const Motion& motion, const Contacts& contacts, const FootskateParams& params = {},
                        double amount = 1) {
  Alone work;
  return clean_footskate(motion, contacts, params, std::vector<double>(motion.frames(), amount), work);
}
Contacts contacts_of(const Motion& motion) {
  Alone work;
  return detect_contacts(motion, {}, work);
}
// The furthest that a planted point gets from the mean of its plant, metres.
double largest_slip(const Motion& motion, const Contacts& contacts) {
  const WorldMotion world = world_motion(motion);
  double slip = 0;
  for (const FootPoint& point : contacts.points) {
    const std::vector<Vec3> path = path_of(point, world);
    for (const kinegraph::Run& run : runs_of(point.planted)) {
      Vec3 mean;
      for (std::size_t t = run.start; t < run.end; ++t)
        mean += path[t] / static_cast<double>(run.end - run.start);
      for (std::size_t t = run.start; t < run.end; ++t) slip = std::max(slip, norm(path[t] - mean));
    }
  }
  return slip;
}
double largest_difference(const Motion& a, const Motion& b) {
  const WorldMotion wa = world_motion(a), wb = world_motion(b);
  double largest = 0;
  for (int joint = 0; joint < a.joints(); ++joint)
    for (std::size_t t = 0; t < a.frames(); ++t)
      largest = std::max(largest, norm(wa.position(joint)[t] - wb.position(joint)[t]));
  return largest;
}

struct Drift {
  std::string clip;  // a gait's name or a file
  double along, across;
};
std::vector<Drift> drifts() {
  std::vector<Drift> all;
  for (const char* name : {"walk", "cmu/bvh/08_01.bvh", "cmu/asfamc/16_31.amc"})
    for (double speed : {0.1, 0.15})
      for (auto [along, across] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}})
        all.push_back({name, speed * along, speed * across});
  return all;
}
class DriftedWalks : public testing::TestWithParam<Drift> {};
INSTANTIATE_TEST_SUITE_P(Feet, DriftedWalks, testing::ValuesIn(drifts()));

TEST_P(DriftedWalks, StandStillWithoutAPop) {
  const Drift& drift = GetParam();
  if (drift.clip != "walk") KINEGRAPH_NEEDS_MOCAP();
  const Motion walk = drift.clip == "walk" ? gait_motion("walk") : clip(drift.clip);
  const Motion motion = drifted(walk, drift.along, drift.across);
  const Contacts contacts = contacts_of(motion);
  ASSERT_GT(largest_slip(motion, contacts), 0.01) << "the input skates";

  const FootskateResult result = cleaned(motion, contacts);

  EXPECT_LT(largest_slip(result.motion, contacts), 0.001);
  EXPECT_LT(result.largest_residual, 1e-6);
  EXPECT_LT(result.largest_stretch, FootskateParams().stretch);

  const WorldMotion before = world_motion(motion), after = world_motion(result.motion);
  const std::vector<Leg> legs = find_legs(motion.skeleton());
  std::vector<std::vector<bool>> near_plants(2, std::vector<bool>(motion.frames(), false));
  for (const FootPoint& point : contacts.points)
    for (const kinegraph::Run& run : runs_of(point.planted))
      for (std::size_t t = run.start < 2 ? 0 : run.start - 2; t < std::min(motion.frames(), run.end + 2); ++t)
        near_plants[point.left ? 0 : 1][t] = true;
  for (int joint = 0; joint < motion.joints(); ++joint) {
    const std::string& name = motion.skeleton().joints[joint].name;
    EXPECT_LT(largest_acceleration(after, joint, motion.fps()),
              1.25 * largest_acceleration(before, joint, motion.fps()))
        << name;
    const std::vector<bool>* near = nullptr;
    for (const Leg& leg : legs)
      if (joint != leg.hip && motion.skeleton().is_below(joint, leg.hip))
        near = &near_plants[leg.left ? 0 : 1];
    for (std::size_t t = 1; t + 1 < motion.frames(); ++t) {
      if (near && (*near)[t]) continue;
      const auto added = [&](std::size_t frame) {
        return after.position(joint)[frame] - before.position(joint)[frame];
      };
      const double acceleration =
          norm(added(t - 1) - 2 * added(t) + added(t + 1)) * motion.fps() * motion.fps();
      ASSERT_LT(acceleration, 50) << name << " at " << t;
    }
  }
}

class FootskateOnGaits : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Footskate, FootskateOnGaits, testing::ValuesIn(gaits()),
                         [](const auto& each) { return each.param; });
TEST_P(FootskateOnGaits, ComesBackUnchangedWhereNothingSkates) {
  const Motion motion = gait_motion(GetParam());
  EXPECT_LT(largest_difference(motion, cleaned(motion, contacts_of(motion)).motion), 0.001);
}
TEST_P(FootskateOnGaits, StandsStillOnASlidingGround) {
  const Motion motion = drifted(gait_motion(GetParam()), 0.1, 0.05);
  const Contacts contacts = contacts_of(motion);
  EXPECT_LT(largest_slip(cleaned(motion, contacts).motion, contacts), 0.001);
}

TEST(Footskate, DefaultStretchIsEnoughForEveryCmuWalkThatDrifts) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* name :
       {"cmu/asfamc/02_01.amc", "cmu/asfamc/07_05.amc", "cmu/asfamc/16_15.amc", "cmu/asfamc/16_31.amc",
        "cmu/asfamc/17_03.amc", "cmu/asfamc/35_01.amc", "cmu/bvh/07_01.bvh", "cmu/bvh/08_01.bvh",
        "cmu/bvh/08_05.bvh", "cmu/bvh/08_07.bvh"}) {
    const Motion walk = clip(name);
    for (double along : {-0.1, 0.1}) {
      const Motion motion = drifted(walk, along, 0);
      EXPECT_LT(cleaned(motion, contacts_of(motion)).largest_residual, 1e-9) << name << ' ' << along;
    }
  }
}

TEST(Footskate, StretchesPlantedLegsByNoMoreThanItsParameter) {
  const Motion motion = drifted(gait_motion("walk"), 0.15, 0);
  const Contacts contacts = contacts_of(motion);
  FootskateParams tight;
  tight.stretch = 0.01;
  const FootskateResult result = cleaned(motion, contacts, tight);
  EXPECT_GE(result.largest_stretch, tight.stretch) << "the legs want more than they may";
  const Skeleton& skeleton = motion.skeleton();
  for (const FootPoint& point : contacts.points) {
    const int ankle = skeleton.find(point.foot),
              knee = skeleton.joints[static_cast<std::size_t>(ankle)].parent;
    for (const int joint : {knee, ankle})
      for (std::size_t t = 0; t < motion.frames(); ++t) {
        if (!point.planted[t]) continue;
        const double times = norm(result.motion.local_offset(joint, t)) / norm(motion.local_offset(joint, t));
        EXPECT_LE(std::abs(times - 1), tight.stretch + 1e-12)
            << skeleton.joints[static_cast<std::size_t>(joint)].name << " " << t;
      }
  }
}

TEST(Footskate, WarnsWhereNoFootIsPlanted) {
  const Motion walk = gait_motion("walk");
  Contacts none = contacts_of(walk);
  for (FootPoint& point : none.points) {
    point.planted.assign(walk.frames(), false);
    point.heights.clear();
  }
  NodeInMemory node(*all_nodes().find("Footskate"));
  node.link("motion", walk).link("contacts", none).run();
  const Diagnostics& told = node.reported();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, "no-plants");
  EXPECT_EQ(told[0].severity, Severity::warning);
  EXPECT_NE(told[0].hint.find("DetectContacts of the clip"), std::string::npos) << told[0].hint;
}

TEST(Footskate, ReportsWhatRigidLegsCannotReach) {
  const Motion motion = drifted(gait_motion("walk"), 0.15, 0);
  const Contacts contacts = contacts_of(motion);
  FootskateParams rigid;
  rigid.stretch = 0;
  Alone work;
  const FootskateResult result =
      clean_footskate(motion, contacts, rigid, std::vector<double>(motion.frames(), 1.0), work);
  EXPECT_GT(result.largest_residual, 0.001);
  EXPECT_EQ(result.largest_stretch, 0);
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "plants-out-of-reach");
  EXPECT_TRUE(work.reported[0].frame);
  EXPECT_FALSE(result.motion.translates(result.motion.skeleton().find("LeftFoot")))
      << "lengths stay as they are";
}

TEST(Footskate, WithoutAmountChangesNothing) {
  const Motion motion = drifted(gait_motion("walk"), 0.15, 0);
  EXPECT_LT(largest_difference(motion, cleaned(motion, contacts_of(motion), {}, 0).motion), 1e-9);
}

TEST(Footskate, PutsPlantsOnAGivenFloor) {
  const Motion motion = gait_motion("walk");
  const Contacts contacts = contacts_of(motion);
  FootskateParams params;
  params.floor = contacts.floor - 0.02;
  const WorldMotion before = world_motion(motion),
                    after = world_motion(cleaned(motion, contacts, params).motion);
  for (const FootPoint& point : contacts.points)
    for (std::size_t t = 0; t < motion.frames(); ++t)
      if (point.planted[t]) {
        EXPECT_NEAR(after.position(point.joint)[t].y, before.position(point.joint)[t].y - 0.02, 0.001) << t;
      }
}

// The walk with straighter knees, whose swinging feet pass under the floor, on the plants of the walk itself.
TEST(Footskate, KeepsSwingingFeetAboveTheFloor) {
  const Motion walk = gait_motion("walk");
  const Contacts contacts = contacts_of(walk);
  Motion motion = walk;
  const std::vector<Leg> legs = find_legs(walk.skeleton());
  for (const Leg& leg : legs)
    for (std::size_t t = 0; t < walk.frames(); ++t)
      motion.rotation(leg.knee).set(t, slerp(0.45, walk.rotation(leg.knee)[t], Quat{}));
  const Motion result = cleaned(motion, contacts).motion;
  const WorldMotion before = world_motion(motion), after = world_motion(result);
  double was = 0;
  for (const Leg& leg : legs) {
    for (std::size_t t = 0; t < walk.frames(); ++t) {
      was = std::max(was, contacts.floor - point_at(before, leg.toe, *leg.toe_tip, t).y);
      EXPECT_GT(point_at(after, leg.toe, *leg.toe_tip, t).y, contacts.floor - 0.012) << t;
      EXPECT_GT(after.position(leg.toe)[t].y, contacts.floor - 0.005) << t;
      EXPECT_GT(after.position(leg.ankle)[t].y, contacts.floor) << t;
    }
  }
  EXPECT_GT(was, 0.04) << "it did pass under the floor";
  EXPECT_LT(largest_slip(result, contacts), 0.001);
  for (int joint = 0; joint < motion.joints(); ++joint) {
    EXPECT_LT(largest_acceleration(after, joint, motion.fps()),
              1.25 * largest_acceleration(before, joint, motion.fps()))
        << motion.skeleton().joints[joint].name;
  }
}

// The motion on a ground that rises along its path.
Motion on_slope(Motion motion, double rise) {
  const Vec3Track root = motion.translation(0);
  Vec3 path = root[motion.frames() - 1] - root[0];
  path.y = 0;
  path = normalized(path);
  const Vec3 start = root[0];
  for (std::size_t t = 0; t < motion.frames(); ++t)
    root.set(t, root[t] + Vec3{0, rise * dot(root[t] - start, path), 0});
  return motion;
}
class FootskateOnSlopes : public testing::TestWithParam<std::tuple<std::string, double>> {};
INSTANTIATE_TEST_SUITE_P(Footskate, FootskateOnSlopes,
                         testing::Combine(testing::Values("walk", "strut", "cmu/bvh/07_01.bvh",
                                                          "cmu/asfamc/35_01.amc"),
                                          testing::Values(-0.12, 0.12)));
TEST_P(FootskateOnSlopes, StandsStillWithoutAPop) {
  const auto& [name, rise] = GetParam();
  if (name.find('/') != name.npos) KINEGRAPH_NEEDS_MOCAP();
  const Motion motion = on_slope(name.find('/') == name.npos ? gait_motion(name) : clip(name), rise);
  DetectContactsParams anywhere;
  anywhere.height = 3;
  Alone work;
  const Contacts contacts = detect_contacts(motion, anywhere, work);
  const Motion result = cleaned(motion, contacts).motion;
  EXPECT_LT(largest_slip(result, contacts), 0.001);
  EXPECT_LT(largest_difference(motion, result), 0.1);
  const WorldMotion before = world_motion(motion), after = world_motion(result);
  for (int joint = 0; joint < motion.joints(); ++joint)
    EXPECT_LT(largest_acceleration(after, joint, motion.fps()),
              1.25 * largest_acceleration(before, joint, motion.fps()))
        << motion.skeleton().joints[joint].name;
}

TEST(Footskate, KeepsWhereTheWalkGoes) {
  const Motion motion = drifted(gait_motion("walk"), 0.15, 0.1);
  const Motion result = cleaned(motion, contacts_of(motion)).motion;
  for (std::size_t t = 0; t < motion.frames(); ++t)
    EXPECT_LT(norm(result.translation(0)[t] - motion.translation(0)[t]), 0.05);
}

TEST(Footskate, RefusesContactsOfAnotherMotion) {
  const Motion motion = gait_motion("walk");
  Contacts contacts = contacts_of(motion);
  Contacts renamed = contacts;
  renamed.points[1].joint_name = "LeftHand";
  EXPECT_THROW(cleaned(motion, renamed), Failure);
  contacts.frames -= 1;
  EXPECT_THROW(cleaned(motion, contacts), Failure);
}

}  // namespace
}  // namespace kinegraph
