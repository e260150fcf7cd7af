#include "nodes/cartoon/link_correction.h"

#include <gtest/gtest.h>

#include <set>

#include "nodes/cartoon/exaggerate.h"
#include "nodes/cartoon/link_turns.h"
#include "nodes/motion/resample.h"
#include "tests/nodes/cartoon/cartoon_clips.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

// Three joints in a row along x, one frame.
Motion row_of_three() {
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {{"a", -1, {}, {}}, {"b", 0, {1, 0, 0}, {}}, {"c", 1, {1, 0, 0}, {}}};
  return Motion(skeleton, std::make_shared<SourceFacts>(), 60, 1, {true, false, false});
}

TEST(LinkCorrection, MovesTheLowerJointByItsPartOfTheViolation) {
  const Motion row = row_of_three();
  const WorldMotion world = world_motion(row);
  const auto on = on_parent(row);
  const auto lengths = link_lengths(row.skeleton(), on, world);
  WorldMotion moved = world;
  moved.position(1).set(0, {1.5, 0, 0});  // the first link too long by 0.5
  moved.position(2).set(0, {1.9, 0, 0});  // the second too short by 0.6
  LinkCorrectionParams params;
  params.delta = 0.5;
  params.error = 0;
  params.iterations = 1;
  Alone work;
  const auto result = correct_links(row.skeleton(), on, lengths, params, moved, work);
  EXPECT_NEAR(moved.position(1)[0].x, 1.25, 1e-15);  // back by half of 0.5
  EXPECT_NEAR(moved.position(2)[0].x, 2.2, 1e-15);   // a squashed link grows; its parent's move isn't shared
  EXPECT_NEAR(result.error_before, (0.5 + 0.6) / 2, 1e-15);
  EXPECT_NEAR(result.error, (0.25 + 0.05) / 2, 1e-15);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_FALSE(result.met);
}

TEST(LinkCorrection, LeavesJointsThatMeetWhereTheyAre) {
  const Motion row = row_of_three();
  const WorldMotion world = world_motion(row);
  WorldMotion moved = world;
  moved.position(2).set(0, {1, 0, 0});  // |w| = 0: there is no direction to go
  LinkCorrectionParams params;
  params.error = 0;
  params.iterations = 5;
  Alone work;
  const auto on = on_parent(row);
  correct_links(row.skeleton(), on, link_lengths(row.skeleton(), on, world), params, moved, work);
  EXPECT_EQ(moved.position(2)[0], (Vec3{1, 0, 0}));
}

TEST(LinkCorrection, KeepsTheBestAndHalvesDeltaWhenTheErrorRises) {
  // Four arms hang on one joint that is pulled out: as it goes back, what it gives to each of the four is
  // more than what it gains.
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {{"root", -1, {}, {}}, {"hub", 0, {1, 0, 0}, {}}};
  for (int i = 0; i < 4; ++i) skeleton->joints.push_back({"arm" + std::to_string(i), 1, {1, 0, 0}, {}});
  const Motion star(skeleton, std::make_shared<SourceFacts>(), 60, 1,
                    {true, false, false, false, false, false});
  const WorldMotion world = world_motion(star);
  WorldMotion moved = world;
  for (int j = 1; j < 6; ++j) moved.position(j).set(0, world.position(j)[0] + Vec3{0.4, 0, 0});
  const auto on = on_parent(star);
  LinkCorrectionParams params;
  params.error = 0.001;
  Alone work;
  const auto result = correct_links(*skeleton, on, link_lengths(*skeleton, on, world), params, moved, work);
  EXPECT_LT(result.delta, params.delta);
  EXPECT_LE(result.error, result.error_before);
  // What is kept has the error that is told.
  LinkCorrectionParams look = params;
  look.iterations = 0;
  const auto again = correct_links(*skeleton, on, link_lengths(*skeleton, on, world), look, moved, work);
  EXPECT_NEAR(again.error, result.error, 1e-15);
}

TEST(LinkCorrection, EndsUnderItsThresholdOnEveryClip) {
  KINEGRAPH_NEEDS_MOCAP();
  int clips = 0;
  for (const std::string& file : every_clip()) {
    const auto loaded = whole_clip(file);
    if (!loaded) continue;
    ++clips;
    for (double fps : {0.0, 30.0}) {
      Alone work;
      const Motion clip = fps > 0 ? resampled(*loaded, fps, work) : *loaded;
      if (clip.frames() < 2) continue;
      const ExaggerateResult result = exaggerate(clip, {}, work);
      const std::string what = file + (fps > 0 ? " at 30" : "");
      EXPECT_TRUE(result.correction.met) << what;
      EXPECT_LE(result.correction.error, 0.03) << what;
      EXPECT_LE(result.correction.iterations, 100) << what;
      // Each link beyond 3 times or under a third of its length has a warning that names joint and frame.
      std::set<std::string> told;
      for (const Diagnostic& d : work.reported)
        if (d.code == "stretched-link" && d.frame.has_value()) told.insert(d.joint);
      const WorldMotion before = world_motion(clip), after = world_motion(result.motion);
      const auto lengths = link_lengths(clip.skeleton(), on_parent(clip), before);
      for (int j = 1; j < clip.joints(); ++j) {
        const LinkStretch stretch = link_stretch(clip.skeleton(), lengths, after, j);
        EXPECT_EQ(told.contains(clip.skeleton().joints[j].name),
                  stretch.largest > 3 || stretch.smallest < 1.0 / 3)
            << what << " " << clip.skeleton().joints[j].name;
      }
      RecordProperty(what, std::to_string(result.correction.iterations) + " iterations, error " +
                               std::to_string(result.correction.error) + ", delta " +
                               std::to_string(result.correction.delta) + ", |w|/|v| " +
                               std::to_string(result.stretch.smallest) + " to " +
                               std::to_string(result.stretch.largest));
    }
  }
  EXPECT_GT(clips, 50);
}

TEST(LinkCorrection, GoesOnUntilMaxLinkHolds) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file : cartoon_clips) {
    Alone work;
    ExaggerateParams params;
    params.correction.max_link = 1.4;
    const ExaggerateResult result = exaggerate(cartoon_clip(file), params, work);
    EXPECT_LE(result.stretch.largest, 1.4 + 1e-9) << file;
    EXPECT_TRUE(result.correction.met) << file;
  }
}

TEST(BestTurn, IsTheRotationBetweenRigidLinks) {
  const Quat q = axis_angle(normalized(Vec3{1, 2, -0.5}), 0.8);
  const Vec3 from[] = {{0.1, 0, 0}, {-0.1, 0.01, 0}, {0, 0.2, 0.05}};
  Vec3 to[3];
  for (int i = 0; i < 3; ++i) to[i] = from[i];
  EXPECT_LT(turn(best_turn(from, to)), 1e-9);
  for (int i = 0; i < 3; ++i) to[i] = rotate(q, from[i]);
  EXPECT_LT(turn(best_turn(from, to), q), 0.05);  // held a little towards no turn
}

TEST(BestTurn, OfLinksInOneLineHasNoTwist) {
  const Vec3 from[] = {{0.1, 0, 0}, {-0.1, 0, 0}};
  const Vec3 to[] = {{0.08, 0.06, 0}, {-0.08, -0.06, 0}};
  const Quat q = best_turn(from, to);
  EXPECT_NEAR(q.x, 0, 1e-12);
  EXPECT_NEAR(q.y, 0, 1e-12);
  EXPECT_GT(turn(q), 0.55);
}

}  // namespace
}  // namespace kinegraph
