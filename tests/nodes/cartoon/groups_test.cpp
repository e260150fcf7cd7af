#include "nodes/cartoon/groups.h"

#include <gmock/gmock.h>

#include "graph/diagnostic.h"
#include "nodes/gait/gait_skeleton.h"
#include "nodes/motion/character.h"
#include "tests/nodes/cartoon/cartoon_clips.h"

namespace kinegraph {
namespace {

using testing::ElementsAre;

std::vector<std::string> groups_as_text(const Skeleton& skeleton) {
  std::vector<std::string> all;
  for (const auto& group : automatic_groups(skeleton, small_ends(skeleton))) {
    std::string text;
    for (int j : group) text += (text.empty() ? "" : " ") + skeleton.joints[j].name;
    all.push_back(text);
  }
  return all;
}

// "a(b(c)d)" in words: each joint with its parent's name.
Skeleton tree(const std::vector<std::pair<std::string, std::string>>& joints) {
  Skeleton skeleton;
  for (const auto& [name, parent] : joints)
    skeleton.joints.push_back({name, skeleton.find(parent), {0.1, 0, 0}, {}});
  return skeleton;
}

Skeleton skeleton_of(const char* file) {
  PlainFiles files;
  Alone work;
  const MotionFile loaded = read_motion_file(mocap(file), {}, files, work);
  if (loaded.motion()) return loaded.motion()->skeleton();
  return *dynamic_cast<const Character&>(*loaded.find("character")).skeleton;
}

TEST(Groups, OfGaitsSkeletonAreLegsArmsAndNeck) {
  EXPECT_THAT(
      groups_as_text(*gait_skeleton({})),
      ElementsAre("LeftUpLeg LeftLeg LeftFoot LeftToeBase", "RightUpLeg RightLeg RightFoot RightToeBase",
                  "Neck Head", "LeftShoulder LeftArm LeftForeArm LeftHand",
                  "RightShoulder RightArm RightForeArm RightHand"));
}

TEST(Groups, OfCmusSkeletonEndWhereFingersPart) {
  KINEGRAPH_NEEDS_MOCAP();
  EXPECT_THAT(groups_as_text(cartoon_clip("cmu/bvh/08_01.bvh", 2).skeleton()),
              ElementsAre("LHipJoint LeftUpLeg LeftLeg LeftFoot LeftToeBase",
                          "RHipJoint RightUpLeg RightLeg RightFoot RightToeBase", "Neck Neck1 Head",
                          "LeftShoulder LeftArm LeftForeArm LeftHand",
                          "RightShoulder RightArm RightForeArm RightHand"));
  EXPECT_THAT(groups_as_text(cartoon_clip("cmu/asfamc/17_10.amc", 2).skeleton()),
              ElementsAre("lhipjoint lfemur ltibia lfoot ltoes", "rhipjoint rfemur rtibia rfoot rtoes",
                          "lowerneck upperneck head", "lclavicle lhumerus lradius lwrist lhand",
                          "rclavicle rhumerus rradius rwrist rhand"));
}

TEST(Groups, OfGltfSamples) {
  KINEGRAPH_NEEDS_MOCAP();
  // Its joints have no names; the arms' first joints hang on the chest with the neck.
  EXPECT_THAT(groups_as_text(skeleton_of("gltf/CesiumMan.glb")),
              ElementsAre("node19 node20", "node16 node17 node18", "node13 node14 node15",
                          "node7 node8 node9 node10", "node3 node4 node5 node6"));
  EXPECT_THAT(groups_as_text(skeleton_of("gltf/Fox.glb")),
              ElementsAre("b_Neck_04 b_Head_05", "b_RightUpperArm_06 b_RightForeArm_07 b_RightHand_08",
                          "b_LeftUpperArm_09 b_LeftForeArm_010 b_LeftHand_011",
                          "b_Tail01_012 b_Tail02_013 b_Tail03_014",
                          "b_LeftLeg01_015 b_LeftLeg02_016 b_LeftFoot01_017 b_LeftFoot02_018",
                          "b_RightLeg01_019 b_RightLeg02_020 b_RightFoot01_021 b_RightFoot02_022"));
  EXPECT_THAT(groups_as_text(skeleton_of("gltf/SimpleSkin.gltf")), ElementsAre("node1 node2"));
  // The Knight's handles for inverse kinematics hang on the root each alone.
  EXPECT_THAT(groups_as_text(skeleton_of("gltf/KayKit_Knight.glb")),
              testing::IsSupersetOf({"upperarm.l lowerarm.l wrist.l hand.l handslot.l", "head",
                                     "upperleg.r lowerleg.r foot.r toes.r", "kneeIK.l"}));
}

TEST(Groups, OfOddSkeletons) {
  KINEGRAPH_NEEDS_MOCAP();
  EXPECT_THAT(groups_as_text(skeleton_of("odd/mae_TORSO_hash.bvh")),
              ElementsAre("TLS LEFT_SHOULDER# LEFT_ELBOW LEFT_HAND",
                          "TRS RIGHT_SHOULDER# RIGHT_ELBOW RIGHT_HAND", "TLH LEFT_HIP# LEFT_KNEE LEFT_FOOT",
                          "TRH RIGHT_HIP# RIGHT_KNEE RIGHT_FOOT", "TN NECK# HEAD"));
  EXPECT_THAT(groups_as_text(skeleton_of("odd/sinusoidal_no_endsite.bvh")),
              ElementsAre("base child1 child2 child3"));
  // A hand of five fingers branches; the fingers aren't limbs.
  EXPECT_THAT(groups_as_text(skeleton_of("odd/makehuman_tpose.bvh")),
              testing::IsSupersetOf(
                  {"clavicle.L shoulder01.L upperarm01.L upperarm02.L lowerarm01.L lowerarm02.L wrist.L",
                   "tongue04"}));
}

TEST(Groups, OfAMixamoLikeSkeletonLeaveOutFingersAndToeEnds) {
  const Skeleton skeleton = tree({{"mixamorig:Hips", ""},
                                  {"mixamorig:Spine", "mixamorig:Hips"},
                                  {"mixamorig:Neck", "mixamorig:Spine"},
                                  {"mixamorig:Head", "mixamorig:Neck"},
                                  {"mixamorig:HeadTop_End", "mixamorig:Head"},
                                  {"mixamorig:LeftArm", "mixamorig:Spine"},
                                  {"mixamorig:LeftForeArm", "mixamorig:LeftArm"},
                                  {"mixamorig:LeftHand", "mixamorig:LeftForeArm"},
                                  {"mixamorig:LeftHandThumb1", "mixamorig:LeftHand"},
                                  {"mixamorig:LeftHandThumb2", "mixamorig:LeftHandThumb1"},
                                  {"mixamorig:LeftHandIndex1", "mixamorig:LeftHand"},
                                  {"mixamorig:LeftHandMiddle1", "mixamorig:LeftHand"},
                                  {"mixamorig:LeftUpLeg", "mixamorig:Hips"},
                                  {"mixamorig:LeftLeg", "mixamorig:LeftUpLeg"},
                                  {"mixamorig:LeftFoot", "mixamorig:LeftLeg"},
                                  {"mixamorig:LeftToeBase", "mixamorig:LeftFoot"},
                                  {"mixamorig:LeftToe_End", "mixamorig:LeftToeBase"}});
  EXPECT_THAT(groups_as_text(skeleton),
              ElementsAre("mixamorig:Neck mixamorig:Head mixamorig:HeadTop_End",
                          "mixamorig:LeftArm mixamorig:LeftForeArm mixamorig:LeftHand",
                          "mixamorig:LeftUpLeg mixamorig:LeftLeg mixamorig:LeftFoot mixamorig:LeftToeBase"));
}

TEST(Groups, PassOverBonesThatShareTwistAndSkin) {
  KINEGRAPH_NEEDS_MOCAP();
  // Character Creator's: twist and share bones beside thighs, calves and arms, five toes below a foot.
  const std::string p = "CC_Base_";
  EXPECT_THAT(
      groups_as_text(cartoon_clip("cmu/bvh_other/007_01_iclone.bvh", 2).skeleton()),
      testing::IsSupersetOf({p + "L_Thigh " + p + "L_Calf " + p + "L_Foot " + p + "L_ToeBase",
                             p + "R_Thigh " + p + "R_Calf " + p + "R_Foot " + p + "R_ToeBase",
                             p + "L_Clavicle " + p + "L_Upperarm " + p + "L_Forearm " + p + "L_Hand",
                             p + "R_Clavicle " + p + "R_Upperarm " + p + "R_Forearm " + p + "R_Hand"}));
}

TEST(Groups, LeaveOutMiddleFingersAndSingleToes) {
  KINEGRAPH_NEEDS_MOCAP();
  EXPECT_THAT(
      groups_as_text(cartoon_clip("cmu/bvh_daz/10_01.bvh", 2).skeleton()),
      ElementsAre("leftEye", "rightEye", "rCollar rShldr rForeArm rHand", "lCollar lShldr lForeArm lHand",
                  "rButtock rThigh rShin rFoot", "lButtock lThigh lShin lFoot"));
  EXPECT_THAT(
      groups_as_text(cartoon_clip("fair/dab.bvh", 2).skeleton()),
      testing::IsSupersetOf({"Neck Head", "RightShoulder RightArm RightForeArm RightHand RightHandEnd",
                             "LeftUpLeg LeftLeg LeftFoot LeftToeBase"}));
  EXPECT_THAT(groups_as_text(cartoon_clip("odd/makehuman_tpose.bvh", 2).skeleton()),
              testing::IsSupersetOf(
                  {"pelvis.L upperleg01.L upperleg02.L lowerleg01.L lowerleg02.L foot.L",
                   "clavicle.R shoulder01.R upperarm01.R upperarm02.R lowerarm01.R lowerarm02.R wrist.R"}));
}

TEST(Groups, OfASingleChainAreAllOfIt) {
  EXPECT_THAT(groups_as_text(tree({{"a", ""}, {"b", "a"}, {"c", "b"}})), ElementsAre("a b c"));
  EXPECT_THAT(groups_as_text(tree({{"alone", ""}})), ElementsAre("alone"));
}

TEST(Groups, EndBelowTheFirstBranchingJoint) {
  EXPECT_THAT(groups_as_text(tree({{"a", ""}, {"b", "a"}, {"c", "b"}, {"d", "b"}, {"e", "d"}})),
              ElementsAre("c", "d e"));  // a has one child, b, which is in no group
}

TEST(Groups, DoNotTakeMiddlesAndStringsForFingers) {
  const Skeleton skeleton =
      tree({{"SpineMiddleBody", ""}, {"Spring", "SpineMiddleBody"}, {"Little", "Spring"}});
  EXPECT_THAT(small_ends(skeleton), ElementsAre(false, false, true));
  // Nor a spine's middle, a neck's twist bones that lead to the head, or an only toe joint.
  EXPECT_THAT(small_ends(tree({{"Spine_Mid1", ""},
                               {"NeckTwist01", "Spine_Mid1"},
                               {"NeckTwist02", "NeckTwist01"},
                               {"Head", "NeckTwist02"},
                               {"Foot", "Spine_Mid1"},
                               {"Toe1", "Foot"}})),
              testing::Each(false));
}

TEST(Groups, CanBeNamed) {
  const Skeleton skeleton = tree({{"a", ""}, {"b", "a"}, {"c", "b"}, {"d", "b"}, {"e", "d"}});
  const auto groups = named_groups(skeleton, {{"a", "c"}, {"d", "e"}});
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_THAT(groups[0], ElementsAre(0, 1, 2));
  const auto refusal = [&](const std::vector<std::pair<std::string, std::string>>& ends) {
    try {
      named_groups(skeleton, ends);
    } catch (const Failure& failure) {
      return failure.diagnostic().code + " " + failure.diagnostic().param;
    }
    return std::string();
  };
  EXPECT_EQ(refusal({{"a", "x"}}), "unknown-joint groups[0]");
  EXPECT_EQ(refusal({{"c", "a"}}), "bad-group groups[0]");
  EXPECT_EQ(refusal({{"a", "c"}, {"b", "e"}}), "bad-group groups[1]");
}

}  // namespace
}  // namespace kinegraph
