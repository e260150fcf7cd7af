// Mirror on real skeletons: sides found by any convention of names, or by shape.
#include <gtest/gtest.h>

#include "nodes/files/motion_file.h"
#include "nodes/motion/joint_names.h"
#include "nodes/motion/kinematics.h"
#include "nodes/time/mirror.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

class MirrorOnClips : public ::testing::TestWithParam<const char*> {};

TEST_P(MirrorOnClips, pairs_every_joint_of_a_side_and_twice_is_the_clip_itself) {
  KINEGRAPH_NEEDS_MOCAP();
  PlainFiles files;
  Alone work;
  const MotionFile file = read_motion_file(mocap(GetParam()), {}, files, work);
  const auto& motion = dynamic_cast<const Motion&>(*file.find("motion"));
  work.reported.clear();
  const Sides sides = find_sides(motion.skeleton(), {}, work);
  for (int j = 0; j < motion.joints(); ++j)
    if (const JointName name = read_joint_name(motion.skeleton().joints[j].name); name.side != Side::middle) {
      const JointName other = read_joint_name(motion.skeleton().joints[sides.partner[j]].name);
      EXPECT_EQ(other.side, name.side == Side::left ? Side::right : Side::left)
          << motion.skeleton().joints[j].name;
      EXPECT_EQ(other.word, name.word);
    }
  for (const Diagnostic& one : work.reported) ADD_FAILURE() << to_text(one);
  const Motion once = mirrored(motion, sides, work), twice = mirrored(once, sides, work);
  const WorldMotion a = world_motion(motion), b = world_motion(twice);
  double turned = 0, moved = 0;
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      turned = std::max(turned, turn(twice.rotation(j)[t], motion.rotation(j)[t]));
      moved = std::max(moved, norm(a.position(j)[t] - b.position(j)[t]));
    }
  EXPECT_LT(turned, 1e-9);
  EXPECT_LT(moved, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Clips, MirrorOnClips,
    ::testing::Values("cmu/asfamc/16_31.amc", "cmu/bvh/08_01.bvh", "cmu/bvh_daz/141_01.bvh",
                      "cmu/bvh_max/131_01.bvh", "cmu/bvh_other/007_01_iclone.bvh", "accad/Male1_B3_Walk.bvh",
                      "bandai/dataset-1_walk_old_001.bvh", "m21/HAPPY.bvh", "odd/Boxing_Toes.bvh",
                      "odd/MS2_8Walk_M.bvh", "odd/mixed_orders_test3.bvh", "gltf/CesiumMan.glb",
                      "gltf/RiggedFigure.glb", "gltf/KayKit_Knight.glb", "gltf/rig_transfer_from_bvh.glb"),
    [](const auto& clip) {
      std::string name = clip.param;
      for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
      return name;
    });

}  // namespace
}  // namespace kinegraph
