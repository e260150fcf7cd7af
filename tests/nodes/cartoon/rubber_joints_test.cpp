#include "nodes/cartoon/rubber_joints.h"

#include <gmock/gmock.h>

#include <cmath>

#include "nodes/cartoon/exaggerate.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/files/bvh_read.h"
#include "nodes/files/bvh_write.h"
#include "nodes/gait/gait_skeleton.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/resample.h"
#include "tests/nodes/cartoon/cartoon_clips.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {

NodeType rubber_joints_node();

namespace {

using testing::Pair;

TEST(SubJoints, AreFiftyEightOnTheSkeletonOf23) {
  Alone work;
  const Motion walk = gait("walk", 1);
  ASSERT_EQ(walk.joints(), 23);
  const SubJoints sub = lay_sub_joints(walk, {}, work);
  EXPECT_EQ(sub.all.size(), 58u);
  std::vector<std::pair<std::string, int>> counts;
  for (int j = 0; j < walk.joints(); ++j)
    counts.emplace_back(walk.skeleton().joints[j].name, sub.all[sub.first[j]].count);
  EXPECT_THAT(counts, testing::ElementsAre(
                          Pair("Hips", 1), Pair("LeftUpLeg", 6), Pair("LeftLeg", 6), Pair("LeftFoot", 2),
                          Pair("LeftToeBase", 1), Pair("RightUpLeg", 6), Pair("RightLeg", 6),
                          Pair("RightFoot", 2), Pair("RightToeBase", 1), Pair("Spine", 2), Pair("Spine1", 1),
                          Pair("Neck", 1), Pair("Head", 1), Pair("LeftShoulder", 2), Pair("LeftArm", 4),
                          Pair("LeftForeArm", 3), Pair("LeftHand", 1), Pair("LeftHandIndex1", 1),
                          Pair("RightShoulder", 2), Pair("RightArm", 4), Pair("RightForeArm", 3),
                          Pair("RightHand", 1), Pair("RightHandIndex1", 1)));
}

TEST(SubJoints, TakeCountsByPattern) {
  Alone work;
  const Motion walk = gait("walk", 1);
  SubJointParams params;
  params.counts = {{"*", 1}, {"LeftArm", 5}};
  EXPECT_EQ(lay_sub_joints(walk, params, work).all.size(), 27u);
  params.counts = {{"Hips", 3}};
  EXPECT_THROW(lay_sub_joints(walk, params, work), Failure);
}

RubberParams still_curve() {
  RubberParams params;
  params.simulate = false;
  return params;
}

TEST(RubberJoints, LeaveTheJointsOnTheCurve) {
  Alone work;
  const Motion run = gait("run", 2);
  const RubberResult rubber = rubber_joints(run, still_curve(), nullptr, work);
  const WorldMotion before = world_motion(run), after = world_motion(rubber.motion);
  for (int j = 0; j < run.joints(); ++j)
    for (std::size_t t = 0; t < run.frames(); ++t)
      ASSERT_LT(norm(after.position(rubber.sub_joints.first[j])[t] - before.position(j)[t]), 1e-9);
  // Hands keep their orientation.
  const int hand = run.skeleton().find("LeftHand");
  EXPECT_LT(turn(after.orientation(rubber.sub_joints.first[hand])[30], before.orientation(hand)[30]), 1e-6);
}

TEST(RubberJoints, WithBlendZeroAreTheCurveExactly) {
  Alone work;
  const Motion run = gait("run", 2);
  RubberParams params;
  params.blend = 0;
  Encoder a, b;
  rubber_joints(run, params, nullptr, work).motion.encode(a);
  rubber_joints(run, still_curve(), nullptr, work).motion.encode(b);
  EXPECT_EQ(a.take(), b.take());
}

TEST(RubberJoints, KeepAStillClipStill) {
  Alone work;
  const Motion walk = gait("walk", 1);
  Motion still = walk.empty_like(80);
  for (int j = 0; j < still.joints(); ++j)
    for (std::size_t t = 0; t < 80; ++t) {
      still.rotation(j).set(t, walk.rotation(j)[20]);
      if (still.translates(j)) still.translation(j).set(t, {0.2, 1, 0.4});
    }
  const Motion swinging = rubber_joints(still, {}, nullptr, work).motion;
  const Motion curve = rubber_joints(still, still_curve(), nullptr, work).motion;
  EXPECT_LT(difference(swinging, curve).position, 1e-12);
  EXPECT_LT(difference(swinging, curve).turn, 1e-9);
}

TEST(RubberJoints, HaveARestPoseOnTheSameCurves) {
  Alone work;
  const Motion walk = gait("walk", 1);
  const RubberResult rubber = rubber_joints(walk, {}, nullptr, work);
  const Skeleton& skeleton = rubber.motion.skeleton();
  const RestPose old_rest = rest_pose(walk.skeleton()), rest = rest_pose(skeleton);
  for (int j = 0; j < walk.joints(); ++j)
    EXPECT_LT(norm(rest.positions[rubber.sub_joints.first[j]] - old_rest.positions[j]), 1e-9);
  EXPECT_EQ(skeleton.joints[rubber.sub_joints.first[walk.skeleton().find("LeftArm")] + 1].name, "LeftArm_2");
  EXPECT_NEAR(rest_height(skeleton), rest_height(walk.skeleton()), 0.03);
}

TEST(RubberJoints, LetPlantedFeetStand) {
  Alone work;
  const Motion walk = gait("walk", 3);
  const Contacts contacts = detect_contacts(walk, {}, work);
  const RubberResult rubber = rubber_joints(walk, {}, &contacts, work);
  const WorldMotion before = world_motion(walk), after = world_motion(rubber.motion);
  int frames = 0;
  for (const FootPoint& point : contacts.points)
    for (std::size_t t = 0; t < walk.frames(); ++t) {
      if (!point.planted[t]) continue;
      ++frames;
      ASSERT_LT(
          norm(after.position(rubber.sub_joints.first[point.joint])[t] - before.position(point.joint)[t]),
          1e-9);
    }
  EXPECT_GT(frames, 100);
}

// Largest turn of a link's direction from one frame to the next, where it has over `part` of its rest length.
double largest_turn(const Motion& motion, double part, std::string* where = nullptr) {
  const WorldMotion world = world_motion(motion);
  double worst = 0;
  for (int j = 1; j < motion.joints(); ++j) {
    const int p = motion.skeleton().joints[j].parent;
    const double rest = motion.skeleton().link_length(j);
    if (rest < 0.01) continue;  // its direction is nobody's
    for (std::size_t t = 1; t < motion.frames(); ++t) {
      const Vec3 a = world.position(j)[t - 1] - world.position(p)[t - 1];
      const Vec3 b = world.position(j)[t] - world.position(p)[t];
      if (norm(a) <= part * rest || norm(b) <= part * rest) continue;
      const double angle = turn(smallest_turn(a, b));
      if (angle > worst && where) *where = motion.skeleton().joints[j].name + " at " + std::to_string(t);
      worst = std::max(worst, angle);
    }
  }
  return worst * degrees_per_radian;
}

// Largest change from frame to frame of the twist of a joint's world orientation about its own link.
double largest_twist(const Motion& motion, std::string* where = nullptr) {
  const WorldMotion world = world_motion(motion);
  double worst = 0;
  for (int j = 1; j < motion.joints(); ++j) {
    const int p = motion.skeleton().joints[j].parent;
    const Vec3 axis = normalized(motion.skeleton().joints[j].offset);
    if (norm(axis) == 0) continue;
    for (std::size_t t = 1; t < motion.frames(); ++t) {
      const Quat step = inverse(world.orientation(p)[t - 1]) * world.orientation(p)[t];
      const double twist = turn(twist_about(step, axis));
      if (twist > worst && where) *where = motion.skeleton().joints[j].name + " at " + std::to_string(t);
      worst = std::max(worst, twist);
    }
  }
  return worst * degrees_per_radian;
}

TEST(RubberJoints, NeverFlipOnRealClips) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file : cartoon_clips) {
    Alone work;
    const Motion clip = resampled(cartoon_clip(file), 120, work);
    const Motion wild = exaggerate(clip, {}, work).motion;
    const Motion rubber = rubber_joints(wild, {}, nullptr, work).motion;
    std::string a, b, c, d;
    const double in_turn = largest_turn(clip, 0.2), in_twist = largest_twist(clip);
    const double wild_turn = largest_turn(wild, 0.2, &a), rubber_turn = largest_turn(rubber, 0.2, &b);
    const double wild_twist = largest_twist(wild, &c), rubber_twist = largest_twist(rubber, &d);
    const double limit = std::max(30.0, 2 * 5 * in_turn);
    EXPECT_LT(wild_turn, limit) << file << " " << a;
    EXPECT_LT(rubber_turn, limit) << file << " " << b;
    EXPECT_LT(wild_twist, std::max(15.0, 1.05 * in_twist)) << file << " " << c;
    // Both nodes may add 5°; next to a wrist that is bent by nearly half a turn the Slerps swing on top of
    // that.
    EXPECT_LT(rubber_twist, std::max(20.0, 2.5 * in_twist)) << file << " " << d;
    RecordProperty(file, "input turns " + std::to_string(in_turn) + " twists " + std::to_string(in_twist) +
                             "; exaggerated " + std::to_string(wild_turn) + " " + std::to_string(wild_twist) +
                             "; rubber " + std::to_string(rubber_turn) + " " + std::to_string(rubber_twist));
  }
}

TEST(RubberJoints, StayNearTheLimbOnRealClips) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file : cartoon_clips) {
    Alone work;
    const Motion clip = cartoon_clip(file);
    RubberParams params = still_curve();
    params.sub_joints.counts = {{"*", 10}};
    const RubberResult rubber = rubber_joints(clip, params, nullptr, work);
    const SubJoints& sub = rubber.sub_joints;
    const WorldMotion before = world_motion(clip), after = world_motion(rubber.motion);
    double worst = 0;
    for (const auto& group : sub.groups) {
      double total = 0;
      for (std::size_t i = 1; i < group.size(); ++i) total += clip.skeleton().link_length(group[i]);
      for (std::size_t i = 0; i + 1 < group.size(); ++i)
        for (int l = 1; l < sub.all[sub.first[group[i]]].count; ++l)
          for (std::size_t t = 0; t < clip.frames(); ++t) {
            const Vec3 p = after.position(sub.first[group[i]] + l)[t];
            double nearest = 1e9;
            for (std::size_t k = 0; k + 1 < group.size(); ++k) {
              const Vec3 a = before.position(group[k])[t], link = before.position(group[k + 1])[t] - a;
              const double along =
                  dot(link, link) > 0 ? std::clamp(dot(p - a, link) / dot(link, link), 0.0, 1.0) : 0;
              nearest = std::min(nearest, norm(p - (a + along * link)));
            }
            worst = std::max(worst, nearest / total);
          }
    }
    EXPECT_LT(worst, 0.3) << file;
    RecordProperty(file, std::to_string(worst) + " of the group's length");
  }
}

TEST(RubberJoints, GoThroughABvhFileAndBack) {
  Alone work;
  const Motion wild = exaggerate(gait("run", 1), {}, work).motion;
  const Motion rubber = rubber_joints(wild, {}, nullptr, work).motion;
  WriteOptions options;
  const std::string text = write_bvh(rubber, options, work);
  ReadOptions reading;
  reading.unit = "cm";
  const Motion back = read_bvh(text, reading, work);
  ASSERT_EQ(back.joints(), rubber.joints());
  const WorldMotion a = world_motion(rubber), b = world_motion(back);
  for (int j = 0; j < rubber.joints(); ++j)
    for (std::size_t t = 0; t < rubber.frames(); ++t)
      ASSERT_LT(norm(a.position(j)[t] - b.position(j)[t]), 1e-6);
}

TEST(RubberJointsNode, FindsContactsAndRefusesOthers) {
  const Motion walk = gait("walk", 2);
  const Motion out = NodeInMemory(rubber_joints_node()).link("motion", walk).run().out<Motion>("motion");
  EXPECT_EQ(out.joints(), 58);
  Contacts short_ones;
  short_ones.frames = 3;
  EXPECT_EQ(
      NodeInMemory(rubber_joints_node()).link("motion", walk).link("contacts", short_ones).refusal().code,
      "frames-differ");
}

}  // namespace
}  // namespace kinegraph
