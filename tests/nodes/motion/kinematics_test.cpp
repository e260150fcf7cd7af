#include "nodes/motion/kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "nodes/motion/points.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

// The oracle: 4 x 4 matrices, multiplied down the tree.
Eigen::Affine3d matrix(Quat q, Vec3 p) {
  return Eigen::Translation3d(p.x, p.y, p.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
}
std::vector<Eigen::Affine3d> matrices(const Motion& motion, std::size_t frame) {
  const Skeleton& s = motion.skeleton();
  Eigen::Affine3d above = matrix(s.above, s.above_offset) * Eigen::Scaling(s.above_scale);
  std::vector<Eigen::Affine3d> all;
  for (int j = 0; j < s.size(); ++j) {
    const auto& parent = s.joints[j].parent < 0 ? above : all[s.joints[j].parent];
    all.push_back(parent * matrix(motion.rotation(j)[frame], motion.local_offset(j, frame)));
  }
  return all;
}
double apart(Vec3 a, const Eigen::Vector3d& b) {
  return norm(a - Vec3{b.x(), b.y(), b.z()});
}

class Kinematics : public ::testing::Test {
 protected:
  static Motion stretched() {
    Skeleton skeleton = sample_skeleton();
    skeleton.above = axis_angle({1, 0, 0}, -0.8);
    skeleton.above_offset = {3, 2, 1};
    skeleton.above_scale = 0.01;
    skeleton.joints[2].rest = axis_angle({0, 0, 1}, 0.5);
    Motion motion = sample_motion(20, 120, 3, skeleton).with_translation(3);
    for (std::size_t t = 0; t < 20; ++t) motion.translation(3).y[t] += 0.01 * static_cast<double>(t);
    return motion;
  }
};

TEST_F(Kinematics, positions_are_those_of_matrices_multiplied_down_the_tree) {
  for (const Motion& motion : {sample_motion(20), stretched()}) {
    WorldMotion world = world_motion(motion);
    for (std::size_t t : {0, 7, 19}) {
      auto truth = matrices(motion, t);
      Pose pose = pose_at(motion, t);
      for (int j = 0; j < motion.joints(); ++j) {
        EXPECT_LT(apart(world.position(j)[t], truth[j].translation()), 1e-14);
        EXPECT_EQ(pose.positions[j], world.position(j)[t]);
        EXPECT_EQ(pose.orientations[j], world.orientation(j)[t]);
        Vec3 local{0.1, 0.2, 0.3};
        EXPECT_LT(apart(point_at(world, j, local, t), truth[j] * Eigen::Vector3d(0.1, 0.2, 0.3)), 1e-14);
      }
    }
  }
}

TEST_F(Kinematics, pieces_of_any_size_give_the_same_bits) {
  class Pieces : public Alone {
   public:
    void parallel(std::size_t count, std::size_t,
                  const std::function<void(std::size_t, std::size_t)>& body) override {
      for (std::size_t from = 0; from < count; from += 3) body(from, std::min(count, from + 3));
    }
  } pieces;
  Motion motion = stretched();
  WorldMotion one = world_motion(motion), other = world_motion(motion, pieces);
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      EXPECT_EQ(one.position(j)[t], other.position(j)[t]);
      EXPECT_EQ(one.orientation(j)[t], other.orientation(j)[t]);
    }
}

TEST_F(Kinematics, link_lengths_dont_change_with_rotations) {
  Motion motion = sample_motion(50);
  WorldMotion world = world_motion(motion);
  for (int j = 1; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < 50; ++t) {
      int parent = motion.skeleton().joints[j].parent;
      EXPECT_NEAR(norm(world.position(j)[t] - world.position(parent)[t]), motion.skeleton().link_length(j),
                  1e-15);
    }
}

TEST_F(Kinematics, a_motion_at_rest_is_the_rest_pose) {
  Skeleton skeleton = stretched().skeleton();
  std::vector<bool> translates(skeleton.joints.size());
  translates[0] = true;
  Motion motion(std::make_shared<const Skeleton>(skeleton), nullptr, 30, 2, translates);
  RestPose rest = rest_pose(skeleton);
  WorldMotion world = world_motion(motion);
  for (int j = 0; j < motion.joints(); ++j) {
    EXPECT_LT(norm(world.position(j)[1] - rest.positions[j]), 1e-15);
    EXPECT_LT(turn(world.orientation(j)[1], rest.orientations[j]), 1e-15);
  }
  for (std::size_t e = 0; e < skeleton.ends.size(); ++e)
    EXPECT_LT(norm(point_at(world, skeleton.ends[e].joint, skeleton.ends[e].offset, 0) - rest.ends[e]),
              1e-15);
}

TEST_F(Kinematics, a_motion_as_points_is_its_joints_linked_to_their_parents) {
  Motion motion = sample_motion(4);
  auto points = std::dynamic_pointer_cast<const Points>(points_of_motion(motion));
  WorldMotion world = world_motion(motion);
  ASSERT_EQ(points->labels.size(), static_cast<std::size_t>(motion.joints()));
  for (int j = 0; j < motion.joints(); ++j) {
    EXPECT_EQ(points->labels[j], motion.skeleton().joints[j].name);
    EXPECT_EQ(points->track(j)[3], world.position(j)[3]);
  }
  ASSERT_EQ(points->links.size(), points->labels.size() - 1);
  EXPECT_EQ(points->links[0], (std::pair{1, 0}));
  EXPECT_EQ(points->fps, motion.fps());
}

TEST_F(Kinematics, one_joint_and_no_frames_are_fine) {
  Skeleton skeleton;
  skeleton.joints = {{"root", -1, {0, 1, 0}, {}}};
  EXPECT_EQ(world_motion(sample_motion(3, 30, 1, skeleton)).frames(), 3u);
  EXPECT_EQ(world_motion(sample_motion(0)).frames(), 0u);
}

}  // namespace
}  // namespace kinegraph
