#include "nodes/motion/skeleton.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

TEST(Skeleton, finds_joints_children_and_descendants) {
  Skeleton s = sample_skeleton();
  EXPECT_EQ(s.joints[s.find("LeftFoot")].name, "LeftFoot");
  EXPECT_EQ(s.find("leftfoot"), -1);
  EXPECT_EQ(s.children(s.find("Spine")),
            (std::vector<int>{s.find("Neck"), s.find("LeftArm"), s.find("RightArm")}));
  EXPECT_TRUE(s.is_below(s.find("LeftHand"), s.find("Spine")));
  EXPECT_TRUE(s.is_below(s.find("Spine"), s.find("Spine")));
  EXPECT_FALSE(s.is_below(s.find("Spine"), s.find("LeftHand")));
  EXPECT_FALSE(s.is_below(s.find("LeftToeBase"), s.find("Spine")));
}

TEST(Skeleton, height_is_measured_along_up_with_end_sites) {
  Skeleton s = sample_skeleton();
  EXPECT_NEAR(rest_height(s), 1.7 - 0.02, 1e-12);  // Head's End Site at 1.7, toes at 0.02
  EXPECT_NEAR(leg_length(s), 0.82, 1e-12);
  s.above_scale = 0.5;
  EXPECT_NEAR(rest_height(s), 0.84, 1e-12);
  EXPECT_NEAR(leg_length(s), 0.41, 1e-12);
}

TEST(Skeleton, of_one_joint_or_none_has_no_legs_and_no_height) {
  Skeleton one;
  one.joints = {{"root", -1, {0, 1, 0}, {}}};
  EXPECT_EQ(rest_height(one), 0);
  EXPECT_TRUE(find_legs(one).empty());
  EXPECT_EQ(leg_length(one), 0);
  EXPECT_TRUE(find_legs(Skeleton{}).empty());
  EXPECT_EQ(rest_height(Skeleton{}), 0);
}

// --- legs ---

// Four names from the hip on ("" = no toe), each convention with what lies above and below a leg in it.
struct Convention {
  const char* name;
  std::vector<const char*> above, left, right, below;
};
const Convention conventions[] = {
    {"CMU BVH",
     {"LHipJoint"},
     {"LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase"},
     {"RightUpLeg", "RightLeg", "RightFoot", "RightToeBase"},
     {}},
    {"CMU AMC",
     {"lhipjoint"},
     {"lfemur", "ltibia", "lfoot", "ltoes"},
     {"rfemur", "rtibia", "rfoot", "rtoes"},
     {}},
    {"DAZ", {"lButtock"}, {"lThigh", "lShin", "lFoot"}, {"rThigh", "rShin", "rFoot"}, {}},
    {"3ds Max",
     {"LHipJoint"},
     {"LeftHip", "LeftKnee", "LeftAnkle", "LeftToe"},
     {"RightHip", "RightKnee", "RightAnkle", "RightToe"},
     {}},
    {"Mixamo",
     {},
     {"mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot", "mixamorig:LeftToeBase"},
     {"mixamorig:RightUpLeg", "mixamorig:RightLeg", "mixamorig:RightFoot", "mixamorig:RightToeBase"},
     {"mixamorig:LeftToe_End"}},
    {"Xsens",
     {},
     {"LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "LeftToe"},
     {"RightUpperLeg", "RightLowerLeg", "RightFoot", "RightToe"},
     {}},
    {"Bandai",
     {},
     {"UpperLeg_L", "LowerLeg_L", "Foot_L", "Toes_L"},
     {"UpperLeg_R", "LowerLeg_R", "Foot_R", "Toes_R"},
     {}},
    {"iClone",
     {"CC_Base_Pelvis"},
     {"CC_Base_L_Thigh", "CC_Base_L_Calf", "CC_Base_L_Foot", "CC_Base_L_ToeBase"},
     {"CC_Base_R_Thigh", "CC_Base_R_Calf", "CC_Base_R_Foot", "CC_Base_R_ToeBase"},
     {"CC_Base_L_BigToe1"}},
    {"underscores",
     {"TLH"},
     {"LEFT_HIP#", "LEFT_KNEE", "LEFT_FOOT"},
     {"RIGHT_HIP#", "RIGHT_KNEE", "RIGHT_FOOT"},
     {}},
    {"Biped",
     {},
     {"Bip01 L Thigh", "Bip01 L Calf", "Bip01 L Foot", "Bip01 L Toe0"},
     {"Bip01 R Thigh", "Bip01 R Calf", "Bip01 R Foot", "Bip01 R Toe0"},
     {}},
};

TEST(Legs, are_found_by_the_names_of_every_convention) {
  for (const Convention& c : conventions) {
    Skeleton s;
    s.joints.push_back({"Hips", -1, {0, 1, 0}, {}});
    // The right one first: order in the file says nothing.
    for (bool left : {false, true}) {
      int parent = 0;
      auto add = [&](const char* name) {
        s.joints.push_back({name, parent, {0, -0.2, 0}, {}});
        parent = s.size() - 1;
      };
      if (left)
        for (const char* name : c.above) add(name);
      for (const char* name : left ? c.left : c.right) add(name);
      if (left)
        for (const char* name : c.below) add(name);
      s.ends.push_back({parent, {0, 0, 0.1}, ""});
    }
    auto legs = find_legs(s);
    ASSERT_EQ(legs.size(), 2u) << c.name;
    for (int side = 0; side < 2; ++side) {
      const auto& names = side == 0 ? c.left : c.right;
      const Leg& leg = legs[side];
      EXPECT_EQ(leg.left, side == 0) << c.name;
      EXPECT_EQ(s.joints[leg.hip].name, names[0]) << c.name;
      EXPECT_EQ(s.joints[leg.knee].name, names[1]) << c.name;
      EXPECT_EQ(s.joints[leg.ankle].name, names[2]) << c.name;
      if (names.size() > 3) {
        EXPECT_EQ(s.joints[leg.toe].name, names[3]) << c.name;
      } else {
        EXPECT_EQ(leg.toe, -1) << c.name;
        EXPECT_TRUE(leg.toe_tip) << c.name;
      }
    }
  }
}

TEST(Legs, of_several_thigh_and_shin_joints_the_topmost_count) {
  Skeleton s;
  for (const char* name :
       {"root", "pelvis.L", "upperleg01.L", "upperleg02.L", "lowerleg01.L", "lowerleg02.L", "foot.L"})
    s.joints.push_back({name, s.size() - 1, {0, -0.1, 0}, {}});
  auto legs = find_legs(s);
  ASSERT_EQ(legs.size(), 1u);
  EXPECT_EQ(s.joints[legs[0].hip].name, "upperleg01.L");
  EXPECT_EQ(s.joints[legs[0].knee].name, "lowerleg01.L");
  EXPECT_TRUE(legs[0].left);
}

Skeleton nameless() {
  Skeleton s = sample_skeleton();
  for (int j = 0; j < s.size(); ++j) s.joints[j].name = "b" + std::to_string(j);
  return s;
}

TEST(Legs, without_names_the_two_lowest_chains_are_legs) {
  Skeleton named = sample_skeleton(), s = nameless();
  for (double facing : {0.0, 1.0, 2.5, -2.0}) {
    s.above = about_y(facing);
    auto legs = find_legs(s), truth = find_legs(named);
    ASSERT_EQ(legs.size(), 2u) << facing;
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(legs[i].hip, truth[i].hip);
      EXPECT_EQ(legs[i].knee, truth[i].knee);
      EXPECT_EQ(legs[i].ankle, truth[i].ankle);
      EXPECT_EQ(legs[i].toe, truth[i].toe);
      EXPECT_EQ(legs[i].left, truth[i].left);
      EXPECT_EQ(legs[i].toe_tip, truth[i].toe_tip);
    }
  }
}

TEST(Legs, by_geometry_step_over_links_without_length) {
  Skeleton s;
  auto add = [&](int parent, Vec3 offset) {
    s.joints.push_back({"b" + std::to_string(s.size()), parent, offset, {}});
    return s.size() - 1;
  };
  add(-1, {0, 1, 0});
  int left_hip = 0;
  for (double side : {-1.0, 1.0}) {
    int socket = add(0, {0, 0, 0});
    left_hip = add(socket, {0.1 * side, -0.05, 0});
    int twist = add(left_hip, {0, 0, 0});
    int knee = add(twist, {0, -0.45, 0});
    int ankle = add(knee, {0, -0.42, 0});
    add(ankle, {0, -0.05, 0.12});
  }
  int chest = add(0, {0, 0.4, 0});
  add(chest, {0, 0.3, 0});
  auto legs = find_legs(s);
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_EQ(legs[0].hip, left_hip);
  EXPECT_EQ(legs[0].knee, left_hip + 2);
  EXPECT_EQ(legs[0].ankle, left_hip + 3);
  EXPECT_EQ(legs[0].toe, left_hip + 4);
}

TEST(Legs, a_chain_or_a_snake_has_none) {
  Skeleton s;
  for (int j = 0; j < 6; ++j) s.joints.push_back({"b" + std::to_string(j), j - 1, {0, j ? 0.1 : 0, 0.1}, {}});
  EXPECT_TRUE(find_legs(s).empty());
  for (Joint& joint : s.joints) joint.offset = {};
  EXPECT_TRUE(find_legs(s).empty());
}

// --- partners ---

Skeleton named(std::vector<const char*> names) {
  Skeleton s;
  for (const char* name : names) s.joints.push_back({name, s.size() - 1, {0, 1, 0}, {}});
  return s;
}

TEST(Partners, are_equal_names_first) {
  EXPECT_EQ(partners(named({"a", "b", "c"}), named({"c", "x", "a"}), {}), (std::vector<int>{2, -1, 0}));
}

TEST(Partners, then_cmus_asf_and_bvh_names_in_both_directions) {
  Skeleton asf =
      named({"root", "lfemur", "ltibia", "lfoot", "ltoes", "upperback", "thorax", "rradius", "rthumb"});
  Skeleton bvh = named({"Hips", "Spine1", "Spine", "LeftToeBase", "LeftFoot", "LeftLeg", "LeftUpLeg",
                        "RThumb", "RightForeArm"});
  auto to_bvh = partners(asf, bvh, {});
  EXPECT_EQ(to_bvh, (std::vector<int>{0, 6, 5, 4, 3, 2, 1, 8, 7}));
  auto to_asf = partners(bvh, asf, {});
  for (int j = 0; j < bvh.size(); ++j) EXPECT_EQ(to_asf[to_bvh[j]], j);
}

TEST(Partners, from_a_map_are_only_those_it_names) {
  EXPECT_EQ(partners(named({"a", "b"}), named({"a", "b"}), {"a=b"}), (std::vector<int>{-1, 0}));
}

TEST(Partners, a_wrong_map_names_its_entry) {
  Skeleton from = named({"Hips", "Spine"}), to = named({"root", "back"});
  auto refusal = [&](std::vector<std::string> map) {
    try {
      partners(from, to, map);
    } catch (const Failure& failure) {
      return failure.diagnostic();
    }
    return Diagnostic{};
  };
  EXPECT_EQ(refusal({"Hips=root", "Spine"}).code, "bad-map");
  EXPECT_EQ(refusal({"Hips=root", "Spine"}).param, "map[1]");
  EXPECT_EQ(refusal({"=root"}).code, "bad-map");
  EXPECT_EQ(refusal({"Hips="}).code, "bad-map");
  EXPECT_EQ(refusal({"Hip=root"}).code, "unknown-joint");
  EXPECT_NE(refusal({"Hip=root"}).hint.find("Hips"), std::string::npos);
  EXPECT_EQ(refusal({"Hips=rot"}).joint, "rot");
  EXPECT_EQ(refusal({"Hips=root", "Spine=root"}).code, "bad-map");
  EXPECT_EQ(refusal({"Hips=root", "Hips=back"}).code, "");  // one joint may drive two
}

}  // namespace
}  // namespace kinegraph
