// Motion warping and cutting by behaviour on captured clips.
#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/files/motion_file.h"
#include "nodes/motion/kinematics.h"
#include "nodes/time/concatenate.h"
#include "nodes/time/motion_warp.h"
#include "nodes/time/segment.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

Motion clip(const std::string& path, FrameRange range = {}) {
  PlainFiles files;
  Alone work;
  ReadOptions options;
  options.range = range;
  return *read_motion_file(mocap(path), options, files, work).motion();
}

TEST(BehaviourPiecesOfRealClips, AreWalkingBoxingAndDancing) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Motion walk = clip("cmu/asfamc/07_05.amc"), boxing = clip("cmu/asfamc/17_10.amc", {0, 720}),
               dance = clip("cmu/asfamc/05_03.amc");
  const Motion joined = concatenated({{&walk, &boxing, &dance}}, {}, work);
  const auto pieces = behaviour_pieces(joined, 1, work);
  ASSERT_EQ(pieces.size(), 3u);
  // Within a quarter of a second of the seams.
  EXPECT_NEAR(static_cast<double>(pieces[1].start), 517, 30);
  EXPECT_NEAR(static_cast<double>(pieces[2].start), 517 + 720, 30);
}

double largest_acceleration(const Motion& motion, int joint, std::size_t from, std::size_t to) {
  const WorldMotion world = world_motion(motion);
  const auto at = world.position(joint);
  double worst = 0;
  for (std::size_t t = from + 1; t + 1 < to; ++t)
    worst = std::max(worst, norm(at[t + 1] - 2 * at[t] + at[t - 1]));
  return worst * motion.fps() * motion.fps();
}

TEST(MotionWarpOfRealClips, ReachesUpWhileWalkingAndKeepsTheStepsDetail) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Motion walk = clip("cmu/asfamc/16_31.amc");
  const Skeleton& skeleton = walk.skeleton();
  const int hand = skeleton.find("rhand"), head = skeleton.find("head"), toes = skeleton.find("ltoes");
  // The right hand up to the height of the eyes at frame 200; anchors a second before and after keep the
  // rest.
  const Vec3 wanted = pose_at(walk, 200).positions[hand] + Vec3{0, 0.45, 0.1};
  const Quat nod = axis_angle({1, 0, 0}, 0.4) * walk.rotation(head)[200];
  std::vector<WarpKey> keys{{200, "rhand", {}, wanted}, {200, "head", nod, {}}};
  for (std::int64_t frame : {80, 320})
    for (const char* joint : {"rhand", "head"}) keys.push_back({frame, joint, {}, {}});
  const Motion out = motion_warp(walk, keys, work);
  EXPECT_LT(norm(pose_at(out, 200).positions[hand] - wanted), 1e-6);
  EXPECT_LT(turn(out.rotation(head)[200], nod), 1e-6);
  const WorldMotion was = world_motion(walk), is = world_motion(out);
  for (std::size_t t = 0; t < walk.frames(); ++t) {
    EXPECT_LT(norm(is.position(toes)[t] - was.position(toes)[t]), 1e-9) << "the feet don't know of it";
    for (int j = 1; j < walk.joints(); ++j) ASSERT_EQ(out.local_offset(j, t), walk.local_offset(j, t));
  }
  EXPECT_LT(largest_acceleration(out, hand, 0, walk.frames()),
            largest_acceleration(walk, hand, 0, walk.frames()) + 40)
      << "nothing pops";
}

}  // namespace
}  // namespace kinegraph
