#include "nodes/motion/body.h"

#include <gtest/gtest.h>

#include "nodes/motion/joint_names.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/time/other_bodies.h"

namespace kinegraph {
namespace {

TEST(JointNames, tell_part_and_side_in_the_conventions_that_are_about) {
  struct Case {
    const char* name;
    Side side;
    BodyPart part;
  };
  for (const Case& one :
       std::initializer_list<Case>{{"mixamorig:LeftUpLeg", Side::left, BodyPart::thigh},
                                   {"mixamorig_RightForeArm", Side::right, BodyPart::forearm},
                                   {"mixamorig9:LeftFoot", Side::left, BodyPart::foot},
                                   {"mixamorig4_RightArm", Side::right, BodyPart::upper_arm},
                                   {"mixamorig12Hips", Side::middle, BodyPart::pelvis},
                                   {"lfemur", Side::left, BodyPart::thigh},
                                   {"rhumerus", Side::right, BodyPart::upper_arm},
                                   {"lclavicle", Side::left, BodyPart::clavicle},
                                   {"rwrist", Side::right, BodyPart::wrist},
                                   {"lThigh", Side::left, BodyPart::thigh},
                                   {"rShldr", Side::right, BodyPart::upper_arm},
                                   {"lCollar", Side::left, BodyPart::clavicle},
                                   {"UpperLeg_L", Side::left, BodyPart::thigh},
                                   {"CC_Base_R_Calf", Side::right, BodyPart::shin},
                                   {"LEFT_HIP#", Side::left, BodyPart::thigh},
                                   {"upperarm.r", Side::right, BodyPart::upper_arm},
                                   {"Bip01 L Clavicle", Side::left, BodyPart::clavicle},
                                   {"DEF-forearm.R", Side::right, BodyPart::forearm},
                                   {"LeftAnkle", Side::left, BodyPart::foot},
                                   {"ball_l", Side::left, BodyPart::toe},
                                   {"LHipJoint", Side::left, BodyPart::none},
                                   {"Hips", Side::middle, BodyPart::pelvis},
                                   {"CC_Base_Hip", Side::middle, BodyPart::pelvis},
                                   {"lowerback", Side::middle, BodyPart::spine},
                                   {"spine_02", Side::middle, BodyPart::spine},
                                   {"upperneck", Side::middle, BodyPart::neck},
                                   {"mixamorig:Head", Side::middle, BodyPart::head},
                                   {"root", Side::middle, BodyPart::none},
                                   {"HeadTop_End", Side::middle, BodyPart::none},
                                   {"elbowIK.l", Side::left, BodyPart::none},
                                   {"CC_Base_L_ThighTwist01", Side::left, BodyPart::none}}) {
    const JointName name = read_joint_name(one.name);
    EXPECT_EQ(name.side, one.side) << one.name;
    EXPECT_EQ(name.part, one.part) << one.name;
  }
  EXPECT_EQ(read_joint_name("mixamorig:LeftHandIndex1").word, "handindex1");
  EXPECT_EQ(read_joint_name("rThumb2").word, "thumb2");
  EXPECT_EQ(read_joint_name("lthumb").word, "thumb");
}

TEST(FindBody, finds_the_same_body_under_any_names_or_none) {
  for (const OtherBody& other : {amc_like(), mixamo_like(), nameless()}) {
    SCOPED_TRACE(other.name);
    const Body body = find_body(other.skeleton);
    const auto at = [&](const char* role) { return other.skeleton.find(other.roles.at(role)); };
    EXPECT_EQ(body.pelvis, at("pelvis"));
    EXPECT_EQ(body.spine.front(), at("spine.1"));
    EXPECT_EQ(body.spine.back(), at("spine.3"));
    EXPECT_EQ(body.neck, std::vector<int>{at("neck.1")});
    EXPECT_EQ(body.head, at("head"));
    ASSERT_EQ(body.arms.size(), 2u);
    EXPECT_TRUE(body.arms[0].left);
    EXPECT_EQ(body.arms[0].upper, at("arm.l"));
    EXPECT_EQ(body.arms[0].forearm, at("forearm.l"));
    EXPECT_EQ(body.arms[0].hand, at("hand.l"));
    EXPECT_EQ(body.arms[1].upper, at("arm.r"));
    EXPECT_EQ(body.arms[0].clavicle, other.roles.count("clavicle.l") ? at("clavicle.l") : -1);
    ASSERT_EQ(body.legs.size(), 2u);
    EXPECT_EQ(body.legs[0].hip, at("thigh.l"));
    EXPECT_EQ(body.legs[1].toe, at("toe.r"));
  }
}

TEST(FindBody, takes_a_shoulder_for_the_arm_only_where_no_arm_is_named) {
  Skeleton s = sample_skeleton();
  for (Joint& joint : s.joints)
    for (auto [from, to] : {std::pair{"ForeArm", "Elbow"}, {"Arm", "Shoulder"}, {"Hand", "Wrist"}})
      if (const auto at = joint.name.find(from); at != joint.name.npos)
        joint.name.replace(at, std::string(from).size(), to);
  const Body body = find_body(s);
  ASSERT_EQ(body.arms.size(), 2u);
  EXPECT_EQ(body.arms[0].upper, s.find("LeftShoulder"));
  EXPECT_EQ(body.arms[0].clavicle, -1);
  EXPECT_EQ(body.arms[0].hand, s.find("LeftWrist"));
}

TEST(FindBody, sees_none_in_a_camera_or_a_prop) {
  Skeleton s;
  EXPECT_EQ(find_body(s).pelvis, -1);
  s.joints.push_back({"Camera", -1, {}, {}});
  s.joints.push_back({"Lens", 0, {0, 0, 0.1}, {}});
  EXPECT_EQ(find_body(s).pelvis, -1);
}

}  // namespace
}  // namespace kinegraph
