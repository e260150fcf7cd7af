#include "nodes/motion/moving_root.h"

#include <gtest/gtest.h>

#include "nodes/files/motion_file.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/kinematics.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

double farthest_apart(const Motion& a, const Motion& b) {
  const WorldMotion p = world_motion(a), q = world_motion(b);
  double most = 0;
  for (int joint = 1; joint < a.joints(); ++joint)
    for (std::size_t t = 0; t < a.frames(); ++t) {
      most = std::max(most, norm(p.position(joint)[t] - q.position(joint)[t]));
      most = std::max(most, turn(p.orientation(joint)[t], q.orientation(joint)[t]));
    }
  return most;
}

// The walk hung below a root that stays at the origin.
Motion below_a_still_root(const Motion& walk) {
  auto skeleton = std::make_shared<Skeleton>(walk.skeleton());
  skeleton->joints.insert(skeleton->joints.begin(), {"reference", -1, {}, {}});
  for (std::size_t j = 1; j < skeleton->joints.size(); ++j) ++skeleton->joints[j].parent;
  for (EndSite& end : skeleton->ends) ++end.joint;
  std::vector<bool> translates(skeleton->joints.size(), false);
  translates[1] = true;
  Motion out(skeleton, walk.shared_source(), walk.fps(), walk.frames(), translates);
  for (int j = 0; j < walk.joints(); ++j)
    for (std::size_t t = 0; t < walk.frames(); ++t) out.rotation(j + 1).set(t, walk.rotation(j)[t]);
  for (std::size_t t = 0; t < walk.frames(); ++t) out.translation(1).set(t, walk.local_offset(0, t));
  return out;
}

TEST(MovingRoot, GivesTheRootThePathAndHeadingOfWhatCarriesTheBody) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const auto hung = std::make_shared<const Motion>(below_a_still_root(walk));
  const auto told = with_moving_root(hung, work);
  ASSERT_NE(told, hung);
  EXPECT_LT(farthest_apart(*told, *hung), 1e-9);
  const EncodedRoot is = encode_root(*told, work), was = encode_root(walk, work);
  for (std::size_t t = 0; t < walk.frames(); ++t) {
    EXPECT_NEAR(is.heading[t], was.heading[t], 1e-9);
    EXPECT_NEAR(is.height[t], was.height[t], 1e-9);
    EXPECT_NEAR(is.d_z[t], was.d_z[t], 1e-6);
  }
}

TEST(MovingRoot, LeavesMotionsAloneWhoseRootMoves) {
  Alone work;
  const auto walk = std::make_shared<const Motion>(gait("walk", 1));
  EXPECT_EQ(with_moving_root(walk, work), walk);
}

TEST(MovingRoot, IsFoundInClipsWithAReferenceJoint) {
  KINEGRAPH_NEEDS_MOCAP();
  PlainFiles files;
  Alone work;
  ReadOptions options;
  options.unit = "cm";
  const MotionFile file = read_motion_file(mocap("bandai/dataset-1_walk_old_001.bvh"), options, files, work);
  const auto motion = std::make_shared<const Motion>(*file.motion());
  const auto told = with_moving_root(motion, work);
  ASSERT_NE(told, motion);
  EXPECT_LT(farthest_apart(*told, *motion), 1e-9);
  EXPECT_GT(norm(told->local_offset(0, told->frames() - 1) - told->local_offset(0, 0)), 3.0);
}

}  // namespace
}  // namespace kinegraph
