// Legs, partners and sides of the skeletons that real files have.
#include <gtest/gtest.h>

#include "nodes/files/motion_file.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/skeleton.h"
#include "nodes/time/mirror.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

Motion clip(const std::string& path) {
  PlainFiles files;
  Alone work;
  return *read_motion_file(mocap(path), {}, files, work).motion();
}

TEST(RealSkeletons, have_their_legs_found_with_toes_where_there_are_any) {
  KINEGRAPH_NEEDS_MOCAP();
  struct Case {
    const char *path, *left_hip, *left_knee, *left_ankle, *left_toe;
  };
  for (const Case& c :
       {Case{"cmu/bvh/08_01.bvh", "LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase"},
        Case{"cmu/asfamc/16_31.amc", "lfemur", "ltibia", "lfoot", "ltoes"},
        Case{"cmu/bvh_daz/10_01.bvh", "lThigh", "lShin", "lFoot", nullptr},
        Case{"cmu/bvh_max/131_01.bvh", "LeftHip", "LeftKnee", "LeftAnkle", "LeftToe"},
        Case{"cmu/bvh_other/007_01_iclone.bvh", "CC_Base_L_Thigh", "CC_Base_L_Calf", "CC_Base_L_Foot",
             "CC_Base_L_ToeBase"},
        Case{"accad/Male1_B3_Walk.bvh", "LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase"},
        Case{"bandai/dataset-1_walk_normal_001.bvh", "UpperLeg_L", "LowerLeg_L", "Foot_L", "Toes_L"},
        Case{"m21/OLD-1.bvh", "LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase"},
        Case{"odd/derived/namespaced_joints.bvh", "mixamorig:LeftUpLeg.x", "mixamorig:LeftLeg.x",
             "mixamorig:LeftFoot.x", "mixamorig:LeftToeBase.x"},
        Case{"odd/makehuman_tpose.bvh", "upperleg01.L", "lowerleg01.L", "foot.L", "metatarsal1.L"},
        Case{"odd/mae_TORSO_hash.bvh", "LEFT_HIP#", "LEFT_KNEE", "LEFT_FOOT", nullptr}}) {
    Skeleton s = clip(c.path).skeleton();
    auto legs = find_legs(s);
    ASSERT_EQ(legs.size(), 2u) << c.path;
    EXPECT_TRUE(legs[0].left && !legs[1].left) << c.path;
    EXPECT_EQ(legs[0].hip, s.find(c.left_hip)) << c.path;
    EXPECT_EQ(legs[0].knee, s.find(c.left_knee)) << c.path;
    EXPECT_EQ(legs[0].ankle, s.find(c.left_ankle)) << c.path;
    EXPECT_EQ(legs[0].toe, c.left_toe ? s.find(c.left_toe) : -1) << c.path;
  }
}

TEST(RealSkeletons, cmus_asf_and_bvh_partners_turn_alike_in_every_frame) {
  KINEGRAPH_NEEDS_MOCAP();
  for (std::string trial : {"02_01", "05_03", "07_05", "09_06"}) {
    Motion bvh = clip("cmu/bvh/" + trial + ".bvh"), amc = clip("cmu/asfamc/" + trial + ".amc");
    ASSERT_EQ(bvh.frames(), amc.frames() + 1);  // the T-pose in front
    auto partner = partners(amc.skeleton(), bvh.skeleton(), {});
    for (int j = 0; j < bvh.joints(); ++j) {
      const std::string& name = bvh.skeleton().joints[j].name;
      ASSERT_GE(partner[j], 0) << name;
      for (std::size_t t = 0; t < amc.frames(); ++t)
        EXPECT_LT(turn(bvh.rotation(j)[t + 1], amc.rotation(partner[j])[t]), 2e-4)
            << trial << " " << name << " " << t;
    }
  }
}

TEST(RealSkeletons, mirrored_stand_with_each_joint_where_its_partner_stood_but_for_their_lengths) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* path : {"cmu/bvh/08_01.bvh", "cmu/asfamc/16_31.amc", "accad/Male1_B3_Walk.bvh",
                           "bandai/dataset-1_walk_normal_001.bvh", "cmu/bvh_daz/10_01.bvh"}) {
    Motion motion = clip(path);
    Alone work;
    Sides sides = find_sides(motion.skeleton(), {}, work);
    Motion out = mirrored(motion, sides, work), back = mirrored(out, sides, work);
    WorldMotion before = world_motion(motion), after = world_motion(out);
    double height = rest_height(motion.skeleton());
    for (int j = 0; j < motion.joints(); ++j)
      for (std::size_t t = 0; t < motion.frames(); t += 7) {
        Vec3 image = reflected(before.position(sides.partner[j])[t], sides.across);
        EXPECT_LT(norm(after.position(j)[t] - image), 0.04 * height)
            << path << " " << motion.skeleton().joints[j].name;
        EXPECT_LT(turn(back.rotation(j)[t], motion.rotation(j)[t]), 1e-12) << path;
      }
  }
}

}  // namespace
}  // namespace kinegraph
