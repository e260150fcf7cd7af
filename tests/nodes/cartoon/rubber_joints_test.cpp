#include "nodes/cartoon/rubber_joints.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <optional>

#include "nodes/cartoon/exaggerate.h"
#include "nodes/cartoon/link_turns.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/feet/foot_points.h"
#include "nodes/files/bvh_read.h"
#include "nodes/files/bvh_write.h"
#include "nodes/gait/gait_skeleton.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/resample.h"
#include "nodes/node_params.h"
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

TEST(SubJoints, AreAsManyOnARestPoseThatIsFolded) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const auto thigh = [&](const char* file, const char* joint) {
    const Motion clip = cartoon_clip(file, 2);
    const SubJoints sub = lay_sub_joints(clip, {}, work);
    EXPECT_LT(sub.all.size(), clip.skeleton().joints.size() + 70) << file;
    return sub.all[sub.first[clip.skeleton().find(joint)]].count;
  };
  EXPECT_EQ(thigh("cmu/bvh/08_01.bvh", "LeftUpLeg"), 7);
  EXPECT_EQ(thigh("cmu/bvh_daz/10_01.bvh", "lThigh"), 6);
  EXPECT_EQ(thigh("fair/dab.bvh", "LeftUpLeg"), 7);
  EXPECT_EQ(thigh("cmu/bvh_other/007_01_iclone.bvh", "CC_Base_L_Thigh"), 7);
  EXPECT_EQ(thigh("bandai/dataset-1_walk_normal_001.bvh", "UpperLeg_L"), 8);
  EXPECT_EQ(thigh("odd/makehuman_tpose.bvh", "lowerleg01.L"), 3);
}

TEST(SubJoints, LeaveLinksAcrossTheTrunkWhole) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Motion clip = cartoon_clip("cmu/bvh/08_01.bvh", 2);
  const SubJoints sub = lay_sub_joints(clip, {}, work);
  for (const char* joint : {"LHipJoint", "RHipJoint", "LowerBack", "Neck", "LeftShoulder", "RightShoulder"})
    EXPECT_EQ(sub.all[sub.first[clip.skeleton().find(joint)]].count, 1) << joint;
}

TEST(SubJoints, LeaveTheWayFromARootOnTheGroundWhole) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  for (const char* file : {"bandai/dataset-1_walk_normal_001.bvh", "gltf/Fox.glb"}) {
    const Motion clip = cartoon_clip(file, 2);
    const SubJoints sub = lay_sub_joints(clip, {}, work);
    EXPECT_EQ(sub.all[0].count, 1) << file;
    EXPECT_GT(sub.all.size(), clip.skeleton().joints.size() + 20) << file;
  }
  // A tube is a limb from its root on.
  const SubJoints tube = lay_sub_joints(cartoon_clip("gltf/RiggedSimple.glb", 2), {}, work);
  EXPECT_GT(tube.all[0].count, 1);
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

// Turn of a link's direction from the frame before, in degrees.
double link_turn(const WorldMotion& world, int from, int to, std::size_t t) {
  const Vec3 before = world.position(to)[t - 1] - world.position(from)[t - 1];
  return turn(smallest_turn(before, world.position(to)[t] - world.position(from)[t])) * degrees_per_radian;
}
double link_length(const WorldMotion& world, int from, int to, std::size_t t) {
  return norm(world.position(to)[t] - world.position(from)[t]);
}

// Change from the frame before of the twist of a joint's world orientation about its link to a joint below.
double twist(const WorldMotion& world, const RestPose& rest, int joint, int below, std::size_t t) {
  const Quat step = inverse(world.orientation(joint)[t - 1]) * world.orientation(joint)[t];
  return turn(twist_about(step, rest_link(rest, joint, joint, below))) * degrees_per_radian;
}

// A link of an output, and that of the input it is part of.
struct LinkPair {
  int from, to, input_from, input_to;
};

// Counts, in every link and frame, what no link may do: turn by more than max(30°, 2 ω times the input's own
// turn) while over 20 % of its length at rest, or twist by more than 15° unless the input does.
void expect_no_flips(const std::string& what, const Motion& input, const Motion& output,
                     const std::vector<LinkPair>& links) {
  constexpr double omega = 5;
  const WorldMotion before = world_motion(input), after = world_motion(output);
  const RestPose old_rest = rest_pose(input.skeleton()), rest = rest_pose(output.skeleton());
  const auto ends = links_below(input);
  const double height = rest_height(input.skeleton());
  int flips = 0, spins = 0;
  double largest_turn = 0, largest_twist = 0;
  std::string where;
  for (const LinkPair& link : links) {
    const double length = output.skeleton().link_length(link.to) * output.skeleton().above_scale;
    if (length < 1e-3 * height) continue;  // its direction is nobody's
    for (std::size_t t = 1; t < input.frames(); ++t) {
      const auto at = [&] {
        return output.skeleton().joints[link.to].name + " at frame " + std::to_string(t);
      };
      if (link_length(after, link.from, link.to, t - 1) > 0.2 * length &&
          link_length(after, link.from, link.to, t) > 0.2 * length) {
        const double turns = link_turn(after, link.from, link.to, t);
        const double own = link_turn(before, link.input_from, link.input_to, t);
        largest_turn = std::max(largest_turn, turns);
        if (turns > std::max(30.0, 2 * omega * own) && ++flips == 1)
          where += at() + " turns by " + std::to_string(turns) + ", input " + std::to_string(own) + "; ";
      }
      const double twists = twist(after, rest, link.from, link.to, t);
      // A sub-joint takes part in what its joint and the one below twist.
      double own = twist(before, old_rest, link.input_from, link.input_to, t);
      if (ends[link.input_to].size() == 1)
        own = std::max(own, twist(before, old_rest, link.input_to, ends[link.input_to][0], t));
      largest_twist = std::max(largest_twist, twists);
      if (twists > std::max(15.0, own * (1 + 1e-6)) && ++spins == 1)
        where += at() + " twists by " + std::to_string(twists) + ", input " + std::to_string(own) + "; ";
    }
  }
  EXPECT_EQ(flips, 0) << what << ": " << where;
  EXPECT_EQ(spins, 0) << what << ": " << where;
  testing::Test::RecordProperty(
      what, "turns " + std::to_string(largest_turn) + ", twists " + std::to_string(largest_twist));
}

// Every sub-link, with the link of the joints that it is part of.
std::vector<LinkPair> links_of(const RubberResult& rubber, const Motion& clip) {
  const SubJoints& sub = rubber.sub_joints;
  const auto ends = links_below(clip);
  std::vector<LinkPair> links;
  for (int i = 0; i < static_cast<int>(sub.all.size()); ++i) {
    const SubJoint& one = sub.all[i];
    if (one.count > 1) {
      links.push_back({i, one.step + 1 < one.count ? i + 1 : sub.first[one.next], one.joint, one.next});
    } else {
      for (int below : ends[one.joint]) links.push_back({i, sub.first[below], one.joint, below});
    }
  }
  return links;
}

TEST(RubberJoints, NeverFlipOnAnyClip) {
  KINEGRAPH_NEEDS_MOCAP();
  int clips = 0;
  for (const std::string& file : every_clip()) {
    Alone work;
    const auto loaded = whole_clip(file);
    if (!loaded) continue;
    const Motion clip = resampled(*loaded, 120, work);
    const Motion wild = exaggerate(clip, {}, work).motion;
    std::vector<LinkPair> links;
    const auto ends = links_below(clip);
    for (int j = 0; j < clip.joints(); ++j)
      for (int below : ends[j]) links.push_back({j, below, j, below});
    expect_no_flips(file + " exaggerated", clip, wild, links);

    std::optional<Contacts> contacts;  // as the node finds them
    try {
      contacts = detect_contacts(wild, {}, work);
    } catch (const Failure&) {
    }
    const RubberResult rubber = rubber_joints(wild, {}, contacts ? &*contacts : nullptr, work);
    expect_no_flips(file + " as rubber", clip, rubber.motion, links_of(rubber, clip));
    ++clips;
  }
  EXPECT_GT(clips, 50);
}

TEST(RubberJoints, NeverFlipHoweverStiffTheSpringsAre) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file : cartoon_clips) {
    Alone work;
    const Motion clip = resampled(cartoon_clip(file, 200), 120, work);
    const Motion wild = exaggerate(clip, {}, work).motion;
    for (const auto& [hook, link, drag] : {std::array{20.0, 0.0, 0.0},
                                           {300.0, 600.0, 0.0},
                                           {1e6, 0.0, 0.0},
                                           {300.0, 1e6, 12.0},
                                           {1.0, 1e4, 1e4}}) {
      RubberParams params;
      params.springs = {hook, link, drag, true, 0};
      params.blend = 1;
      const RubberResult rubber = rubber_joints(wild, params, nullptr, work);
      expect_no_flips(std::string(file) + " hook " + std::to_string(hook) + " link " + std::to_string(link) +
                          " drag " + std::to_string(drag),
                      clip, rubber.motion, links_of(rubber, clip));
    }
  }
}

TEST(RubberJoints, HaveTheFeetOfTheirInput) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  std::vector<Motion> clips{gait("walk", 1)};
  for (const char* file : {"cmu/bvh/08_01.bvh", "cmu/asfamc/17_10.amc", "m21/kick.bvh", "gltf/CesiumMan.glb",
                           "cmu/bvh_daz/10_01.bvh", "bandai/dataset-1_walk_normal_001.bvh"})
    clips.push_back(cartoon_clip(file, 20));
  for (const Motion& clip : clips) {
    const Motion rubber = rubber_joints(clip, {}, nullptr, work).motion;
    const auto names = [](const Skeleton& skeleton) {
      std::vector<std::string> all;
      for (const Leg& leg : find_legs(skeleton))
        for (int j : {leg.hip, leg.knee, leg.ankle, leg.toe})
          all.push_back(j < 0 ? "none" : skeleton.joints[j].name);
      return all;
    };
    EXPECT_THAT(names(rubber.skeleton()), testing::ElementsAreArray(names(clip.skeleton())));
    const auto points = [&](const Skeleton& skeleton) {
      std::vector<std::string> all;
      for (const FootPoint& point : foot_points(skeleton, "", "", work))
        all.push_back(point.part + " " + point.joint_name);
      return all;
    };
    EXPECT_THAT(points(rubber.skeleton()), testing::ElementsAreArray(points(clip.skeleton())));
    EXPECT_FALSE(points(clip.skeleton()).empty());
  }
}

TEST(RubberJoints, HaveTheRestPoseOfTheirInputForThoseWhoCompare) {
  Alone work;
  const Motion walk = gait("walk", 1);
  const Skeleton& plain = walk.skeleton();
  const Motion rubber = rubber_joints(walk, {}, nullptr, work).motion;
  warn_about_partners(rubber.skeleton(), plain, partners(rubber.skeleton(), plain, {}), work);
  warn_about_partners(plain, rubber.skeleton(), partners(plain, rubber.skeleton(), {}), work);
  for (const Diagnostic& told : work.reported) EXPECT_NE(told.code, "rest-pose-differs") << told.message;
  // A limb that hangs elsewhere is told of as ever.
  Skeleton bent = plain;
  bent.joints[plain.find("LeftForeArm")].offset = {0, -0.28, 0};
  Alone other;
  warn_about_partners(rubber.skeleton(), bent, partners(rubber.skeleton(), bent, {}), other);
  ASSERT_FALSE(other.reported.empty());
  EXPECT_EQ(other.reported.back().code, "rest-pose-differs");
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

TEST(RubberJointsNode, TellsOfItsLimbsAndOfFeetThatNeverRest) {
  const auto told = [](const Motion& motion) {
    NodeInMemory node(rubber_joints_node());
    node.link("motion", motion).run();
    return node.reported();
  };
  const Diagnostics walks = told(gait("walk", 2));
  ASSERT_EQ(walks.size(), 1u);
  EXPECT_EQ(walks[0].code, "sub-joints");
  EXPECT_THAT(walks[0].message,
              testing::AllOf(testing::HasSubstr("23 joints"), testing::HasSubstr("58 sub-joints"),
                             testing::HasSubstr("LeftUpLeg…LeftToeBase 15")));
  Motion flight = gait("run", 2);
  for (std::size_t t = 0; t < flight.frames(); ++t)
    flight.translation(0).set(t,
                              flight.translation(0)[t] + Vec3{0, std::sin(0.9 * static_cast<double>(t)), 0});
  const Diagnostics flies = told(flight);
  ASSERT_EQ(flies.size(), 2u);
  EXPECT_EQ(flies[0].code, "no-contacts");
  EXPECT_THAT(flies[0].hint, testing::HasSubstr("before"));
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
