#include "nodes/time/mirror.h"

#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
namespace {

class Mirror : public ::testing::Test {
 protected:
  Alone work;

  static Skeleton nameless() {
    Skeleton s = sample_skeleton();
    for (int j = 0; j < s.size(); ++j) s.joints[j].name = "b" + std::to_string(j);
    return s;
  }
  // Fixed parents, rest rotations that differ from side to side, a stretching joint.
  static Motion awkward() {
    Skeleton s = sample_skeleton();
    s.above = axis_angle({1, 0, 0}, -pi / 2);
    s.above_scale = 0.01;
    s.above_offset = {0, 0.5, 0};
    s.joints[0].rest = axis_angle({1, 0, 0}, pi / 2);
    s.joints[2].rest = axis_angle({0, 1, 0}, 0.7);
    s.joints[3].rest = axis_angle({0, 0, 1}, -0.4);
    Motion motion = sample_motion(30, 120, 4, s).with_translation(2);
    for (std::size_t t = 0; t < 30; ++t) motion.translation(2).x[t] += 0.002 * static_cast<double>(t);
    return motion;
  }
};

TEST_F(Mirror, of_a_symmetric_skeleton_every_joint_stands_at_its_partners_reflection) {
  Motion motion = sample_motion(30);
  Sides sides = find_sides(motion.skeleton(), {}, work);
  Motion out = mirrored(motion, sides, work);
  WorldMotion before = world_motion(motion), after = world_motion(out);
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < 30; ++t) {
      Vec3 p = before.position(sides.partner[j])[t];
      EXPECT_LT(norm(after.position(j)[t] - Vec3{-p.x, p.y, p.z}), 1e-14);
    }
  EXPECT_TRUE(work.reported.empty());
}

TEST_F(Mirror, twice_is_the_motion_itself) {
  for (const Motion& motion : {sample_motion(30), awkward()}) {
    Sides sides = find_sides(motion.skeleton(), {}, work);
    Motion back = mirrored(mirrored(motion, sides, work), sides, work);
    WorldMotion before = world_motion(motion), after = world_motion(back);
    for (int j = 0; j < motion.joints(); ++j)
      for (std::size_t t = 0; t < 30; ++t) {
        EXPECT_LT(turn(back.rotation(j)[t], motion.rotation(j)[t]), 1e-13) << j;
        EXPECT_LT(norm(after.position(j)[t] - before.position(j)[t]), 1e-13) << j;
      }
  }
}

TEST_F(Mirror, of_a_symmetric_rest_pose_is_that_pose) {
  Skeleton skeleton = sample_skeleton();
  skeleton.above = axis_angle({1, 0, 0}, -pi / 2);
  skeleton.joints[0].rest = axis_angle({1, 0, 0}, pi / 2);
  skeleton.joints[0].offset = {};
  for (const char* arm : {"LeftArm", "RightArm"})
    skeleton.joints[skeleton.find(arm)].rest = axis_angle({0, 0, 1}, arm[0] == 'L' ? -1 : 1);
  Motion rest = sample_motion(2, 120, 1, skeleton).empty_like(2);
  Motion out = mirrored(rest, find_sides(skeleton, {}, work), work);
  for (int j = 0; j < rest.joints(); ++j) EXPECT_LT(turn(out.rotation(j)[1], rest.rotation(j)[1]), 1e-14);
}

TEST_F(Mirror, pairs_joints_by_the_names_of_their_sides) {
  Skeleton s;
  for (const char* name : {"root", "lfemur", "rfemur", "Foot_L", "Foot_R", "CC_L_Hand", "CC_R_Hand",
                           "LHipJoint", "RHipJoint", "LEFT_ELBOW", "RIGHT_ELBOW", "eye.l", "eye.r",
                           "lowerback", "mixamorig:LeftArm", "mixamorig:RightArm"})
    s.joints.push_back({name, s.size() ? 0 : -1, {0, 0.1, 0}, {}});
  EXPECT_EQ(find_sides(s, {}, work).partner,
            (std::vector<int>{0, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11, 13, 15, 14}));
}

TEST_F(Mirror, pairs_joints_without_names_by_the_rest_pose) {
  auto by_name = find_sides(sample_skeleton(), {}, work);
  auto by_shape = find_sides(nameless(), {}, work);
  EXPECT_EQ(by_shape.partner, by_name.partner);
  EXPECT_EQ(by_name.across, (Vec3{1, 0, 0}));
}

TEST_F(Mirror, finds_the_plane_of_a_skeleton_that_faces_elsewhere) {
  Skeleton s = sample_skeleton();
  s.above = about_y(0.8);
  Sides sides = find_sides(s, {}, work);
  EXPECT_LT(norm(sides.across - rotate(s.above, {1, 0, 0})), 1e-14);
  Motion motion = sample_motion(10, 120, 1, s), out = mirrored(motion, sides, work);
  WorldMotion before = world_motion(motion), after = world_motion(out);
  for (int j = 0; j < motion.joints(); ++j) {
    Vec3 p = before.position(sides.partner[j])[9];
    EXPECT_LT(norm(after.position(j)[9] - (p - 2 * dot(p, sides.across) * sides.across)), 1e-14);
  }
}

TEST_F(Mirror, takes_pairs_as_told_and_the_rest_by_name) {
  Skeleton s = sample_skeleton();
  int arm = s.find("LeftArm"), other = s.find("RightArm"), neck = s.find("Neck"), head = s.find("Head");
  Sides sides = find_sides(s, {"Neck=Head"}, work);
  EXPECT_EQ(sides.partner[neck], head);
  EXPECT_EQ(sides.partner[head], neck);
  EXPECT_EQ(sides.partner[arm], other);
}

// As some exporters write it: every bone along x of its own axes, backwards on the right; the spine as well.
// The rest pose shows no body.
Skeleton bones_along_x() {
  Skeleton s;
  auto add = [&](const char* name, const char* parent, Vec3 offset) {
    s.joints.push_back({name, s.joints.empty() ? -1 : s.find(parent), offset, {}});
  };
  add("root", "", {0, 0, 0});
  add("Hips", "root", {0, 0.94, -0.03});
  add("Spine", "Hips", {0.16, 0, 0});
  add("Chest", "Spine", {0.09, -0.004, 0});
  add("Neck", "Chest", {0.16, 0, 0});
  add("Arm_L", "Chest", {0.13, -0.002, 0.05});
  add("Hand_L", "Arm_L", {0.24, 0, 0});
  add("Arm_R", "Chest", {0.13, -0.002, -0.05});
  add("Hand_R", "Arm_R", {-0.24, 0, 0});
  add("UpperLeg_L", "Hips", {-0.02, -0.065, 0});
  add("LowerLeg_L", "UpperLeg_L", {0.39, 0, 0});
  add("Foot_L", "LowerLeg_L", {0.41, 0, 0});
  add("UpperLeg_R", "Hips", {-0.02, 0.065, 0});
  add("LowerLeg_R", "UpperLeg_R", {-0.39, 0, 0});
  add("Foot_R", "LowerLeg_R", {-0.41, 0, 0});
  return s;
}

TEST_F(Mirror, of_a_rest_pose_that_is_no_body_still_reflects_every_joint) {
  Motion motion = sample_motion(20, 120, 6, bones_along_x(), 1.5).with_translation(6);
  for (std::size_t t = 0; t < 20; ++t) motion.translation(6).y[t] += 0.01 * static_cast<double>(t);
  Sides sides = find_sides(motion.skeleton(), {}, work);
  Motion out = mirrored(motion, sides, work), back = mirrored(out, sides, work);
  EXPECT_TRUE(work.reported.empty());
  WorldMotion before = world_motion(motion), after = world_motion(out);
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < 20; ++t) {
      // The spine's small bend isn't mirrored; left wrong way round a joint would be off by tenths of a
      // metre.
      Vec3 p = before.position(sides.partner[j])[t];
      EXPECT_LT(norm(after.position(j)[t] - reflected(p, sides.across)), 1e-13)
          << motion.skeleton().joints[j].name;
      EXPECT_LT(turn(back.rotation(j)[t], motion.rotation(j)[t]), 1e-13);
    }
}

NodeInMemory mirror() {
  return NodeInMemory(*all_nodes().find("Mirror"));
}

TEST_F(Mirror, refuses_wrong_pairs_by_their_place) {
  auto refusal = [](Json::Array pairs) {
    return mirror().link("motion", sample_motion(5)).set("pairs", std::move(pairs)).refusal();
  };
  EXPECT_EQ(refusal({"LeftArm=RightArm", "LeftFoot"}).param, "pairs[1]");
  EXPECT_EQ(refusal({"LeftArm=RightAm"}).code, "unknown-joint");
  EXPECT_EQ(refusal({"LeftArm=RightArm", "LeftArm=Head"}).code, "bad-map");
}

TEST_F(Mirror, names_joints_that_have_no_other_side) {
  Skeleton s = sample_skeleton();
  s.joints[s.find("LeftHand")].name = "Hook";
  find_sides(s, {}, work);
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "no-mirror-partner");
  EXPECT_NE(work.reported[0].message.find("Hook"), std::string::npos);
}

TEST_F(Mirror, as_a_node_gives_the_same_and_works_without_frames) {
  auto node = mirror();
  node.link("motion", sample_motion(0)).run();
  EXPECT_EQ(node.out<Motion>("motion").frames(), 0u);
}

}  // namespace
}  // namespace kinegraph
