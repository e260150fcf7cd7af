#include "nodes/feet/detect_contacts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "graph/diagnostic.h"
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

// The rule that DetectContacts is held to: under 0.25 m/s over ±4 frames at 120 fps and under the 10th
// percentile of its height + 4 cm, in runs over 0.1 s.
Flags rule(const Motion& motion, const FootPoint& point) {
  const WorldMotion world = world_motion(motion);
  const auto side = static_cast<std::size_t>(std::lround(4 * motion.fps() / 120));
  std::vector<Vec3> path;
  std::vector<double> heights;
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    path.push_back(point_at(world, point.joint, point.local, t));
    heights.push_back(path.back().y);
  }
  std::sort(heights.begin(), heights.end());
  const double ceiling = heights[(heights.size() - 1) / 10] + 0.04;
  Flags flags(motion.frames());
  for (std::size_t t = 0; t < flags.size(); ++t) {
    const std::size_t a = t < side ? 0 : t - side, b = std::min(flags.size() - 1, t + side);
    const double speed = norm(path[b] - path[a]) * motion.fps() / static_cast<double>(b - a);
    flags[t] = speed < 0.25 && path[t].y < ceiling;
  }
  for (const kinegraph::Run& run : runs_of(flags))
    for (std::size_t t = run.start; t < run.end; ++t)
      if (static_cast<double>(run.end - run.start) <= 0.1 * motion.fps()) flags[t] = false;
  return flags;
}
Flags rule(const Motion& motion, const Contacts& points, bool left) {
  Flags heel = rule(motion, point_of(points, left, "heel")),
        ball = rule(motion, point_of(points, left, "ball"));
  for (std::size_t t = 0; t < heel.size(); ++t) heel[t] = heel[t] || ball[t];
  return heel;
}

// How many frames there were to agree about.
struct Compared {
  std::size_t planted = 0, found = 0;  // by the rule; and of those by DetectContacts
  std::size_t free = 0, wrong = 0;     // not planted by the rule; and of those held by DetectContacts
};
Compared compared(const Motion& motion) {
  const Contacts contacts = detected(motion);
  Compared frames;
  for (bool left : {true, false}) {
    const Flags expected = rule(motion, contacts, left), got = planted(contacts, left);
    for (std::size_t t = 0; t < got.size(); ++t) {
      (expected[t] ? frames.planted : frames.free) += 1;
      (expected[t] ? frames.found : frames.wrong) += got[t];
    }
  }
  return frames;
}
void expect_agrees_with_rule(const Motion& motion, const std::string& name) {
  const Compared frames = compared(motion);
  fmt::print("{}: {} of {} planted frames are found, {} of {} others are taken for planted\n", name,
             frames.found, frames.planted, frames.wrong, frames.free);
  EXPECT_GE(10 * frames.found, 9 * frames.planted);
  EXPECT_LE(10 * frames.wrong, frames.free);
}

// Every plant that the rule knows of, and every one that is found on firm ground, is still found on a ground
// that slides.
void expect_drift_loses_nothing(const Motion& motion) {
  const Contacts still = detected(motion);
  for (double speed : {0.02, 0.05, 0.08, 0.1, 0.12, 0.15}) {
    for (int way = 0; way < 16; ++way) {
      const double angle = way * 3.14159265 / 8;
      const Contacts contacts = detected(drifted(motion, speed * std::cos(angle), speed * std::sin(angle)));
      for (bool left : {true, false}) {
        const Flags got = planted(contacts, left);
        const auto expect_kept = [&](const Flags& plants, const char* whose) {
          for (const kinegraph::Run& plant : runs_of(plants)) {
            const bool kept =
                std::any_of(got.begin() + static_cast<std::ptrdiff_t>(plant.start),
                            got.begin() + static_cast<std::ptrdiff_t>(plant.end), [](bool on) { return on; });
            EXPECT_TRUE(kept) << whose << (left ? " left " : " right ") << plant.start << " to " << plant.end
                              << " at " << speed << " m/s, " << way << "/16 of a turn";
          }
        };
        expect_kept(rule(motion, still, left), "the rule's");
        expect_kept(planted(still, left), "its own");
      }
    }
  }
}

class DetectContactsOnGaits : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Feet, DetectContactsOnGaits, testing::ValuesIn(gaits()),
                         [](const auto& each) { return each.param; });
TEST_P(DetectContactsOnGaits, AgreeWithTheRule) {
  expect_agrees_with_rule(gait_motion(GetParam()), GetParam());
  EXPECT_GT(compared(gait_motion(GetParam())).planted, 50u);
}
TEST_P(DetectContactsOnGaits, LoseNoPlantToDrift) {
  expect_drift_loses_nothing(gait_motion(GetParam()));
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
INSTANTIATE_TEST_SUITE_P(Feet, DetectContactsOnClips, testing::ValuesIn(walks_and_runs()),
                         [](const auto& each) {
                           std::string name = each.param.substr(4);
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
                           return name;
                         });
TEST_P(DetectContactsOnClips, AgreeWithTheRule) {
  KINEGRAPH_NEEDS_MOCAP();
  const Motion motion = clip(GetParam());
  expect_agrees_with_rule(motion, GetParam());
  // A runner's feet rest for less than the rule's 0.1 s; a walker's don't.
  if (!runs(GetParam())) {
    EXPECT_GT(compared(motion).planted, 20u);
  }
}
TEST_P(DetectContactsOnClips, LoseNoPlantToDrift) {
  KINEGRAPH_NEEDS_MOCAP();
  expect_drift_loses_nothing(clip(GetParam()));
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
