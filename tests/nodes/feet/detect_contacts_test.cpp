#include "nodes/feet/detect_contacts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "graph/diagnostic.h"
#include "tests/nodes/feet/independent_feet.h"
#include "tests/nodes/feet/walks_and_runs.h"

namespace kinegraph {
namespace {

using Flags = std::vector<bool>;

Contacts detected(const Motion& motion, const DetectContactsParams& params = {}) {
  Alone work;
  return detect_contacts(motion, params, work);
}
const FootPoint& point_of(const Contacts& contacts, bool left, std::string_view part) {
  for (const FootPoint& point : contacts.points)
    if (point.left == left && point.part == part) return point;
  throw std::runtime_error("no such point");
}
// Heel or ball of one foot is planted.
Flags planted(const Contacts& contacts, bool left) {
  Flags flags(contacts.frames, false);
  for (const FootPoint& point : contacts.points)
    for (std::size_t t = 0; t < contacts.frames && point.left == left; ++t)
      flags[t] = flags[t] || point.planted[t];
  return flags;
}

// Frames of either foot, by the rule and by DetectContacts, both with the same shortest time.
struct Compared {
  std::size_t planted = 0, found = 0;  // by the rule; and of those by DetectContacts
  std::size_t free = 0, wrong = 0;     // not planted by the rule; and of those held by DetectContacts
};
Compared compared(const Motion& motion, double least) {
  DetectContactsParams params;
  params.min_time = least;
  const Contacts contacts = detected(motion, params);
  Compared frames;
  for (bool left : {true, false}) {
    const Flags expected = independent::rests(motion, left, least), got = planted(contacts, left);
    for (std::size_t t = 0; t < got.size(); ++t) {
      (expected[t] ? frames.planted : frames.free) += 1;
      (expected[t] ? frames.found : frames.wrong) += got[t];
    }
  }
  return frames;
}
// How many frames the rule judges planted is told, and must be as many as `at_least`: else nothing is
// compared.
void expect_agrees_with_rule(const Motion& motion, const std::string& name, double least,
                             std::size_t at_least) {
  const Compared frames = compared(motion, least);
  fmt::print("{}: over {} s, {} of {} planted frames are found, {} of {} others are taken for planted\n",
             name, least, frames.found, frames.planted, frames.wrong, frames.free);
  EXPECT_GE(frames.planted, at_least) << "frames that the rule knows to be planted";
  EXPECT_GE(10 * frames.found, 9 * frames.planted);
  EXPECT_LE(10 * frames.wrong, frames.free);
}

// Every plant that the rule knows of is still found on a ground that slides, and every one that is found on
// firm ground keeps at least 80 % of its frames.
void expect_drift_loses_nothing(const Motion& motion, double least, std::size_t plants_at_least) {
  DetectContactsParams params;
  params.min_time = least;
  const Contacts still = detected(motion, params);
  std::size_t plants = 0;
  for (double speed : {0.05, 0.1, 0.15}) {
    for (int way = 0; way < 16; ++way) {  // 0, 4, 8, 12: along, across, and back
      const double angle = way * 3.14159265358979 / 8;
      const Contacts contacts =
          detected(drifted(motion, speed * std::cos(angle), speed * std::sin(angle)), params);
      for (bool left : {true, false}) {
        const Flags got = planted(contacts, left);
        const auto expect_kept = [&](const Flags& flags, double share, const char* whose) {
          for (const kinegraph::Run& plant : runs_of(flags)) {
            const auto kept = std::count(got.begin() + static_cast<std::ptrdiff_t>(plant.start),
                                         got.begin() + static_cast<std::ptrdiff_t>(plant.end), true);
            EXPECT_GE(static_cast<double>(kept), share * static_cast<double>(plant.end - plant.start))
                << whose << (left ? " left " : " right ") << plant.start << " to " << plant.end << " at "
                << speed << " m/s, " << way << "/16 of a turn: " << kept << " frames";
            ++plants;
          }
        };
        expect_kept(independent::rests(motion, left, least), 0.5, "the rule's");
        expect_kept(planted(still, left), 0.8, "its own");
      }
    }
  }
  EXPECT_GE(plants, 48 * plants_at_least);
}

class DetectContactsOnGaits : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Feet, DetectContactsOnGaits, testing::ValuesIn(gaits()),
                         [](const auto& each) { return each.param; });
TEST_P(DetectContactsOnGaits, AgreeWithTheRule) {
  expect_agrees_with_rule(gait_motion(GetParam()), GetParam(), 0.1, 200);
}
TEST_P(DetectContactsOnGaits, LoseNoPlantToDrift) {
  expect_drift_loses_nothing(gait_motion(GetParam()), 0.1, 8);
}
TEST_P(DetectContactsOnGaits, HoldOnlyPointsThatRest) {
  const Motion motion = gait_motion(GetParam());
  const WorldMotion world = world_motion(motion);
  int plants = 0;
  for (const FootPoint& point : detected(motion).points) {
    for (const kinegraph::Run& run : runs_of(point.planted)) {
      ++plants;
      for (std::size_t t = run.start; t < run.end; ++t)
        EXPECT_LT(
            norm(world.position(point.joint)[t] - world.position(point.joint)[(run.start + run.end) / 2]),
            0.001)
            << point.joint_name << " at " << t;
    }
  }
  EXPECT_GE(plants, 8);
}

class DetectContactsOnClips : public testing::TestWithParam<std::string> {};
const auto file_name = [](const auto& each) {
  std::string name = each.param.substr(4);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
};
INSTANTIATE_TEST_SUITE_P(Feet, DetectContactsOnClips, testing::ValuesIn(walks_and_runs()), file_name);
// A runner's feet rest for less than 0.1 s, and the rule's plants of 0.04 s (the graphs' min_time for runs)
// are compared. In the 74 frames of 141_01 toes and heels are nowhere slow and low at once for any time.
TEST_P(DetectContactsOnClips, AgreeWithTheRule) {
  KINEGRAPH_NEEDS_MOCAP();
  const bool never_rests = GetParam().find("141_01") != std::string::npos;
  const Motion motion = clip(GetParam());
  expect_agrees_with_rule(motion, GetParam(), 0.1, runs(GetParam()) ? 0 : 30);
  if (runs(GetParam())) expect_agrees_with_rule(motion, GetParam(), 0.04, never_rests ? 0 : 20);
  if (never_rests) {
    EXPECT_EQ(compared(motion, 0.01).planted, 0u) << "then it belongs among the others";
  }
}
TEST_P(DetectContactsOnClips, LoseNoPlantToDrift) {
  KINEGRAPH_NEEDS_MOCAP();
  const bool never_rests = GetParam().find("141_01") != std::string::npos;
  expect_drift_loses_nothing(clip(GetParam()), 0.1, runs(GetParam()) ? 0 : 4);
  if (runs(GetParam())) expect_drift_loses_nothing(clip(GetParam()), 0.04, never_rests ? 0 : 4);
}

// Clips that no limit was chosen on.
class DetectContactsElsewhere : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(
    Feet, DetectContactsElsewhere,
    testing::Values("m21/OLD-1.bvh", "m21/HAPPY.bvh", "m21/kick.bvh", "bandai/dataset-1_walk_normal_001.bvh",
                    "bandai/dataset-1_walk_old_001.bvh", "bandai/dataset-1_walk_proud_001.bvh",
                    "accad/Male1_B3_Walk.bvh", "odd/MS2_8Walk_M.bvh", "xia/neutral_01_000.bvh",
                    "xia/angry_13_000.bvh", "xia/old_13_000.bvh", "xia/strutting_01_000.bvh"),
    file_name);
TEST_P(DetectContactsElsewhere, AgreeWithTheRuleAndLoseNoPlantToDrift) {
  KINEGRAPH_NEEDS_MOCAP();
  const Motion motion = clip(GetParam());
  expect_agrees_with_rule(motion, GetParam(), 0.1, 50);
  expect_drift_loses_nothing(motion, 0.1, 4);
}

// Slides that no drift explains: each foot its own way, or one step this way and the next one that way.
TEST(DetectContacts, FindsPlantsThatSlideEachItsOwnWay) {
  const Motion walk = gait_motion("walk");
  const Contacts still = detected(walk);
  const auto sliding = [&](auto way_of) {
    // While a foot stands alone, the body goes its way; in double support the ways pass into each other.
    std::vector<double> speed(walk.frames());
    std::vector<bool> known(walk.frames());
    std::size_t step = 0;
    bool was_left = false;
    for (std::size_t t = 0; t < walk.frames(); ++t) {
      const bool left = planted(still, true)[t], right = planted(still, false)[t];
      if (left == right) continue;
      step += known.end() == std::find(known.begin(), known.end(), true) || left != was_left;
      was_left = left;
      speed[t] = 0.15 * way_of(left, step);
      known[t] = true;
    }
    const auto any = static_cast<std::size_t>(std::find(known.begin(), known.end(), true) - known.begin());
    for (std::size_t t = 0; t < walk.frames(); ++t)
      if (!known[t]) speed[t] = t == 0 ? speed[any] : speed[t - 1];
    Motion motion = walk;
    double across = 0;
    for (std::size_t t = 0; t < walk.frames(); ++t) {
      across += speed[t] / walk.fps();
      motion.translation(0).set(t, walk.translation(0)[t] + Vec3{across, 0, 0});
    }
    return motion;
  };
  const Motion by_foot = sliding([](bool left, std::size_t) { return left ? 1 : -1; });
  const Motion by_pair = sliding([](bool, std::size_t step) { return step / 2 % 2 ? 1 : -1; });
  for (const Motion* motion : {&by_foot, &by_pair}) {
    const Contacts contacts = detected(*motion);
    for (bool left : {true, false}) {
      const Flags got = planted(contacts, left);
      for (const kinegraph::Run& plant : runs_of(planted(still, left))) {
        if (plant.end == contacts.frames) continue;  // only begun, while the other foot's way still holds
        const auto kept = std::count(got.begin() + static_cast<std::ptrdiff_t>(plant.start),
                                     got.begin() + static_cast<std::ptrdiff_t>(plant.end), true);
        EXPECT_GE(2 * static_cast<std::size_t>(kept), plant.end - plant.start)
            << (motion == &by_foot ? "by foot" : "by pair") << (left ? " left " : " right ") << plant.start;
      }
    }
  }
}

TEST(DetectContacts, NamesHeelAndBallOfBothFeet) {
  const Contacts contacts = detected(gait_motion("walk"));
  ASSERT_EQ(contacts.points.size(), 4u);
  EXPECT_EQ(contacts.points[0].joint_name, "LeftFoot");
  EXPECT_EQ(contacts.points[1].joint_name, "LeftToeBase");
  EXPECT_EQ(contacts.points[2].foot, "RightFoot");
  EXPECT_EQ(contacts.points[3].part, "ball");
  EXPECT_NEAR(contacts.floor, 0.01, 0.011);
}

TEST(DetectContacts, AppliesEditsInOrder) {
  const Motion motion = gait_motion("walk");
  DetectContactsParams params;
  params.edits = {{"left", "both", {10, 40}, true}, {"LeftFoot", "heel", {20, 30}, false}};
  const Contacts contacts = detected(motion, params);
  EXPECT_TRUE(point_of(contacts, true, "heel").planted[19]);
  EXPECT_FALSE(point_of(contacts, true, "heel").planted[20]);
  EXPECT_TRUE(point_of(contacts, true, "heel").planted[30]);
  EXPECT_TRUE(point_of(contacts, true, "ball").planted[25]);
  EXPECT_EQ(planted(contacts, false), planted(detected(motion), false));
}

std::string code_of(const Motion& motion, const DetectContactsParams& params) {
  try {
    detected(motion, params);
  } catch (const Failure& failure) {
    EXPECT_FALSE(failure.diagnostic().param.empty());
    return failure.diagnostic().code;
  }
  return "";
}
TEST(DetectContacts, RefusesEditsOfNothing) {
  const Motion motion = gait_motion("walk");
  DetectContactsParams params;
  params.edits = {{"LeftHand", "both", {0, 10}, true}};
  EXPECT_EQ(code_of(motion, params), "unknown-foot");
  params.edits = {{"left", "both", {0, 100000}, true}};
  EXPECT_EQ(code_of(motion, params), "bad-range");
}

// The ball of a runner's foot rests for 0.06 s: under what is a plant by default.
TEST(DetectContacts, TellsWhereNothingIsPlantedAndFindsARunnersPlantsWhenAsked) {
  KINEGRAPH_NEEDS_MOCAP();
  const Motion run = clip("cmu/asfamc/16_45.amc");
  Alone work;
  detect_contacts(run, {}, work);
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "no-contacts");
  DetectContactsParams params;
  params.min_time = 0.04;
  const Contacts contacts = detected(run, params);
  for (bool left : {true, false}) {
    const auto plants = runs_of(planted(contacts, left));
    ASSERT_EQ(plants.size(), left ? 1u : 2u);
    for (const kinegraph::Run& plant : plants) EXPECT_LT(plant.end - plant.start, 12u);
  }
}

TEST(DetectContacts, TakesJointsByPattern) {
  DetectContactsParams params;
  params.heels = "*ToeBase";
  const Contacts contacts = detected(gait_motion("walk"), params);
  EXPECT_EQ(point_of(contacts, false, "heel").joint_name, "RightToeBase");
  params.heels = "LeftToBase";
  EXPECT_EQ(code_of(gait_motion("walk"), params), "unknown-joint");
}

}  // namespace
}  // namespace kinegraph
