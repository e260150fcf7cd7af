#include "nodes/judge/measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>

#include "nodes/gait/gait.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/metric_name.h"
#include "nodes/style/quat_stats.h"
#include "tests/nodes/style/independent_style_distance.h"
#include "tests/nodes/style/small_motion.h"

namespace kinegraph {
namespace {

const Vec3 right{1, 0, 0};
constexpr double pi = 3.14159265358979323846;

Motion gait(const char* name, double seconds = 2) {
  Alone work;
  GaitParams params;
  params.gait = name;
  params.seconds = seconds;
  return make_gait(params, work);
}
Metrics measured(const Motion& motion, const Motion* reference = nullptr, const Contacts* contacts = nullptr,
                 const MeasureParams& params = {}) {
  Alone work;
  return measure(motion, reference, contacts, params, work);
}
std::optional<double> value(const Metrics& metrics, const std::string& name) {
  const Metric* found = metrics.find(name);
  EXPECT_TRUE(found) << name;
  return found ? found->value : std::nullopt;
}

// A foot-like point on the head of a small motion, planted in the frames given.
Contacts planted_head(const Motion& motion, std::vector<bool> planted, double floor = 0) {
  Contacts contacts;
  contacts.fps = motion.fps();
  contacts.frames = motion.frames();
  contacts.floor = floor;
  contacts.points = {{"Head", true, "heel", 2, "Head", {}, std::move(planted)}};
  return contacts;
}

TEST(Measures, AlwaysNameAllTwelveFirstInOneOrder) {
  const std::vector<std::string> names = {"skate",
                                          "skate_share",
                                          "penetration",
                                          "jerk",
                                          "sparc",
                                          "acceleration_max",
                                          "angular_acceleration_max",
                                          "bone_drift",
                                          "position_distance",
                                          "rotation_distance",
                                          "aligned_distance",
                                          "style_distance"};
  for (const Motion& motion : {gait("walk"), SmallMotion{}.made(10), SmallMotion{}.made(1)}) {
    const Metrics metrics = measured(motion);
    ASSERT_GE(metrics.all.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(metrics.all[i].name, names[i]);
  }
}

TEST(Measures, HaveNamesThatRulesCanSpeakOf) {
  auto skeleton = std::make_shared<Skeleton>(*three_joints());
  skeleton->joints[1].name = "mixamo:Spine 1";
  skeleton->joints[2].name = "mixamo_Spine 1";
  const Motion motion(skeleton, std::make_shared<SourceFacts>(), 120, 20, {true, false, false});
  const Metrics metrics = measured(motion);
  const std::regex plain("[A-Za-z0-9_.-]+");
  std::set<std::string> seen;
  for (const Metric& metric : metrics.all) {
    EXPECT_TRUE(std::regex_match(metric.name, plain)) << metric.name;
    EXPECT_TRUE(seen.insert(metric.name).second) << metric.name;
  }
  EXPECT_TRUE(metrics.find("jerk.mixamo_Spine_1"));
  EXPECT_TRUE(metrics.find("jerk.mixamo_Spine_1_2"));
  EXPECT_EQ(joint_metric_name("jerk", "Bein links/ä"), "jerk.Bein_links___");
}

TEST(Measures, AreNullWithoutReferencePlantsOrFrames) {
  const Metrics alone = measured(SmallMotion{}.made(1));
  for (const char* name : {"skate", "skate_share", "penetration", "jerk", "sparc", "acceleration_max",
                           "angular_acceleration_max", "position_distance", "rotation_distance",
                           "aligned_distance", "style_distance", "jerk.Head", "style_distance.Head"}) {
    EXPECT_FALSE(value(alone, name)) << name;
  }
  const Motion still = SmallMotion{}.made(60);
  const Contacts never = planted_head(still, std::vector<bool>(60, false));
  const Metrics unplanted = measured(still, nullptr, &never);
  EXPECT_FALSE(value(unplanted, "skate"));
  EXPECT_FALSE(value(unplanted, "skate_share"));
  EXPECT_EQ(value(unplanted, "penetration"), 0);
  EXPECT_FALSE(value(unplanted, "sparc"));
  EXPECT_FALSE(unplanted.non_finite());
}

TEST(Measures, SkateIsTheMeanHorizontalSpeedOfPlantedFrames) {
  SmallMotion sliding;  // 0.3 m/s along x, bobbing; the plant takes frames 10 to 29
  sliding.place = [](double s) { return Vec3{0.3 * s, 1 + 0.01 * std::sin(20 * s), 0}; };
  const Motion motion = sliding.made(60);
  std::vector<bool> planted(60, false);
  for (std::size_t t = 10; t < 30; ++t) planted[t] = true;
  const Contacts contacts = planted_head(motion, planted);
  const Metrics metrics = measured(motion, nullptr, &contacts);
  EXPECT_NEAR(*value(metrics, "skate"), 0.3, 1e-9);
  EXPECT_NEAR(*value(metrics, "skate.Head"), 0.3, 1e-9);
  EXPECT_EQ(value(metrics, "skate_share"), 1);
  EXPECT_FALSE(metrics.find("skate.Spine"));
}

TEST(Measures, SkateShareCountsFramesOverFiveCentimetresASecond) {
  SmallMotion speeding;  // from rest, 0.1 m/s² : over 0.05 m/s in the second half
  speeding.place = [](double s) { return Vec3{0.05 * s * s, 1, 0}; };
  const Motion motion = speeding.made(121);
  const Contacts contacts = planted_head(motion, std::vector<bool>(121, true));
  const Metrics metrics = measured(motion, nullptr, &contacts);
  EXPECT_NEAR(*value(metrics, "skate_share"), 0.5, 1e-9);
  EXPECT_NEAR(*value(metrics, "skate"), 0.05, 1e-9);
}

TEST(Measures, SkateDoesNotBlameTheStepBetweenTwoPlants) {
  SmallMotion stepping;  // stands, jumps 1 m between frames 29 and 30, stands
  stepping.place = [](double s) { return Vec3{std::lround(s * 120) < 30 ? 0.0 : 1.0, 1, 0}; };
  const Motion motion = stepping.made(60);
  std::vector<bool> planted(60, true);
  planted[29] = false;
  const Contacts contacts = planted_head(motion, planted);
  EXPECT_NEAR(*value(measured(motion, nullptr, &contacts), "skate"), 0, 1e-12);
}

TEST(Measures, PenetrationIsTheMeanDepthUnderTheFloor) {
  SmallMotion sinking;  // the head is at 1.7 m and sinks to 1.5 m in the second half
  sinking.place = [](double s) { return Vec3{0, std::lround(s * 120) < 50 ? 1.0 : 0.8, 0}; };
  const Motion motion = sinking.made(100);
  const Contacts contacts = planted_head(motion, std::vector<bool>(100, true), 1.6);
  EXPECT_NEAR(*value(measured(motion, nullptr, &contacts), "penetration"), 0.05, 1e-12);
}

TEST(Measures, JerkIsTheThirdDerivative) {
  SmallMotion cubic;
  cubic.place = [](double s) { return Vec3{0, 1, 2 * s * s * s}; };
  const Metrics metrics = measured(cubic.made(100));
  EXPECT_NEAR(*value(metrics, "jerk"), 12, 1e-4);
  EXPECT_NEAR(*value(metrics, "jerk.Hips"), 12, 1e-4);
}

TEST(Measures, AccelerationsAreThoseOfASwing) {
  // Slow against the 15 Hz of the low-pass: 0.1 m and 0.5 rad at 1 Hz.
  SmallMotion swinging;
  swinging.place = [](double s) { return Vec3{0.1 * std::sin(2 * pi * s), 1, 0}; };
  swinging.head = [](double s) { return axis_angle(right, 0.5 * std::sin(2 * pi * s)); };
  const Metrics metrics = measured(swinging.made(361));
  const double square = 4 * pi * pi;
  EXPECT_NEAR(*value(metrics, "acceleration_max.Hips"), 0.1 * square, 0.02 * square * 0.1);
  EXPECT_NEAR(*value(metrics, "acceleration_max"), 0.1 * square, 0.02 * square * 0.1);
  EXPECT_NEAR(*value(metrics, "angular_acceleration_max.Head"), 0.5 * square, 0.02 * square * 0.5);
  EXPECT_NEAR(*value(metrics, "angular_acceleration_max.Spine"), 0, 1e-6);
}

TEST(Measures, ASpikeOfOneFrameIsSoftenedByTheLowPass) {
  SmallMotion spiked;
  spiked.place = [](double s) { return Vec3{std::lround(s * 120) == 60 ? 0.02 : 0.0, 1, 0}; };
  const double raw = 2 * 0.02 * 120 * 120;
  const double filtered = *value(measured(spiked.made(121)), "acceleration_max");
  EXPECT_GT(filtered, 1);
  EXPECT_LT(filtered, 0.25 * raw);
}

TEST(Measures, BoneDriftIsTheLargestChangeOfLength) {
  Motion motion = SmallMotion{}.made(40).with_translation(2);
  EXPECT_NEAR(*value(measured(motion), "bone_drift"), 0, 1e-12);
  motion.translation(2).set(7, {0, 0.4 * 1.1, 0});
  motion.translation(2).set(20, {0, 0.4 * 0.85, 0});
  const Metrics metrics = measured(motion);
  EXPECT_NEAR(*value(metrics, "bone_drift"), 0.15, 1e-12);
  EXPECT_NEAR(*value(metrics, "bone_drift.Head"), 0.15, 1e-12);
  EXPECT_EQ(value(metrics, "bone_drift.Spine"), 0);
  EXPECT_FALSE(value(metrics, "bone_drift.Hips"));
}

TEST(Measures, DistancesFrameByFrame) {
  SmallMotion moved, bent;
  moved.place = [](double) { return Vec3{3, 1, 4}; };
  bent.head = [](double) { return axis_angle(right, 30 * pi / 180); };
  const Motion reference = SmallMotion{}.made(50);
  const Motion apart = moved.made(50);
  const Metrics away = measured(apart, &reference);
  EXPECT_NEAR(*value(away, "position_distance"), 5, 1e-12);
  EXPECT_NEAR(*value(away, "rotation_distance"), 0, 1e-6);
  EXPECT_NEAR(*value(away, "aligned_distance"), 0, 1e-12);
  const Motion tilted = bent.made(50);
  const Metrics tilt = measured(tilted, &reference);
  EXPECT_NEAR(*value(tilt, "rotation_distance.Head"), 30, 1e-9);
  EXPECT_NEAR(*value(tilt, "rotation_distance"), 10, 1e-9);
}

TEST(Measures, DistancesFrameByFrameAreNullWhereTheFrameCountsDiffer) {
  const Motion a = gait("walk", 2);
  const Motion b = gait("sneak", 1.5);
  const Metrics metrics = measured(a, &b);
  EXPECT_FALSE(value(metrics, "position_distance"));
  EXPECT_FALSE(value(metrics, "rotation_distance"));
  EXPECT_FALSE(value(metrics, "position_distance.Hips"));
  EXPECT_TRUE(value(metrics, "aligned_distance"));
  EXPECT_TRUE(value(metrics, "style_distance"));
}

TEST(Measures, AlignedDistanceForgivesTimingPlaceAndHeading) {
  // One nod, and the same at another pace, elsewhere and facing another way.
  const auto nod = [](double pace) {
    return [pace](double s) { return axis_angle(right, 0.8 * std::sin(pace * s)); };
  };
  SmallMotion a, b;
  a.spine = nod(6);
  b.spine = nod(5);
  b.hips = [](double) { return about_y(1.3); };
  b.place = [](double) { return Vec3{2, 1, -3}; };
  const Motion quick = a.made(static_cast<std::size_t>(120 * 2 * pi / 6));
  const Motion slow = b.made(static_cast<std::size_t>(120 * 2 * pi / 5));
  const double aligned = *value(measured(quick, &slow), "aligned_distance");
  EXPECT_LT(aligned, 0.004);
  SmallMotion c;
  c.spine = [](double s) { return axis_angle({0, 0, 1}, 0.8 * std::sin(6 * s)); };
  const Motion sideways = c.made(quick.frames());
  EXPECT_GT(*value(measured(sideways, &slow), "aligned_distance"), 10 * aligned);
}

TEST(Measures, StyleDistanceIsTheIndependentOne) {
  const Motion walk = gait("walk");
  for (const char* name : {"sneak", "hobble", "walk"}) {
    const Motion reference = gait(name);
    Alone work;
    const Stats stats = quat_stats(reference, {}, work);
    const auto expected =
        independent::style_distance(walk, stats, partners(reference.skeleton(), walk.skeleton(), {}));
    const Metrics metrics = measured(walk, &reference);
    // Arc cosines near zero are good to some 1e-6 degrees.
    EXPECT_NEAR(*value(metrics, "style_distance"), expected.mean, 1e-5) << name;
    std::size_t counted = 0;
    for (const Metric& metric : metrics.all)
      counted += metric.name.rfind("style_distance.", 0) == 0 && metric.value;
    EXPECT_EQ(counted, expected.joints.size());
  }
}

TEST(Measures, StyleDistanceLeavesOutJointsThatAreRigidInBoth) {
  SmallMotion a, b;
  a.spine = [](double s) { return axis_angle(right, 0.4 * std::sin(6 * s)); };
  b.spine = [](double s) { return axis_angle(right, 0.3 + 0.4 * std::sin(6 * s)); };
  b.head = [](double) { return axis_angle(right, 1.0); };  // another pose, held still by both
  const Motion reference = b.made(240);
  const Metrics metrics = measured(a.made(240), &reference);
  EXPECT_FALSE(value(metrics, "style_distance.Head"));
  EXPECT_NEAR(*value(metrics, "style_distance"), *value(metrics, "style_distance.Spine"), 1e-12);
}

TEST(Measures, LookAtTheJointsAndFramesAskedFor) {
  SmallMotion late;  // the head jerks only in the second half
  late.head = [](double s) { return axis_angle(right, s < 0.5 ? 0.0 : 0.5 * std::sin(40 * (s - 0.5))); };
  const Motion motion = late.made(121);
  MeasureParams params;
  params.joints = {true, true, false};
  const Metrics without_head = measured(motion, nullptr, nullptr, params);
  EXPECT_NEAR(*value(without_head, "angular_acceleration_max"), 0, 1e-6);
  EXPECT_FALSE(without_head.find("angular_acceleration_max.Head"));
  MeasureParams early;
  early.window = {0, 40};
  EXPECT_LT(*value(measured(motion, nullptr, nullptr, early), "angular_acceleration_max"), 1);
  EXPECT_GT(*value(measured(motion), "angular_acceleration_max"), 100);
}

TEST(Measures, RefuseAReferenceOfAnotherRateAndContactsOfAnotherLength) {
  const Motion motion = SmallMotion{}.made(30);
  const Motion slower = SmallMotion{}.made(30, 60);
  const auto code = [&](const Motion* reference, const Contacts* contacts) -> std::string {
    try {
      measured(motion, reference, contacts);
    } catch (const Failure& failure) {
      return failure.diagnostic().code;
    }
    return "";
  };
  EXPECT_EQ(code(&slower, nullptr), "rate-mismatch");
  const Contacts others = planted_head(SmallMotion{}.made(20), std::vector<bool>(20, true));
  EXPECT_EQ(code(nullptr, &others), "length-mismatch");
}

}  // namespace
}  // namespace kinegraph
