#include "nodes/files/bvh_write.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/files/acclaim_motion.h"
#include "nodes/files/bvh_read.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"
#include "tests/mocap.h"
#include "tests/nodes/files/bvh_texts.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

Motion read(const std::string& text, const Json& unit = "m") {
  Alone work;
  ReadOptions options;
  options.unit = unit;
  return read_bvh(text, options, work);
}
std::string written(const Motion& motion, WriteOptions options = {}) {
  Alone work;
  return write_bvh(motion, options, work);
}
double largest_distance(const Motion& a, const Motion& b) {
  const WorldMotion in_a = world_motion(a), in_b = world_motion(b);
  double worst = 0;
  for (int j = 0; j < a.joints(); ++j) {
    const int other = b.skeleton().find(a.skeleton().joints[j].name);
    EXPECT_GE(other, 0) << a.skeleton().joints[j].name;
    for (std::size_t t = 0; other >= 0 && t < a.frames(); ++t)
      worst = std::max(worst, norm(in_a.position(j)[t] - in_b.position(other)[t]));
  }
  return worst;
}

TEST(BvhWrite, GivesBackTheTextItRead) {
  const std::string text = small_bvh(
      "Frames: 2\nFrame Time: .0400\n1.000000 2.000000 3.000000 190.000000 20.000000 -530.000000 "
      "-5.000000 90.000000 7.000000\n1.500000 2.000000 3.000000 -171.000000 21.000000 31.000000 "
      "-6.000000 90.000000 8.000000\n");
  EXPECT_EQ(written(read(text)), text);
}

TEST(BvhWrite, KeepsWrapsOfAnglesThatWereChangedALittle) {
  std::string text = "Frames: 30\nFrame Time: 0.04\n";
  for (int t = 0; t < 30; ++t) text += "0 0 0 " + std::to_string(100 + 10 * t) + " 20 30 0 0 0\n";
  Motion motion = read(small_bvh(text));
  const Quat nudge = axis_angle({0, 0, 1}, 0.01);
  for (std::size_t t = 0; t < 30; ++t) motion.rotation(0).set(t, nudge * motion.rotation(0)[t]);
  const Motion back = read(written(motion));
  for (std::size_t t = 0; t < 30; ++t)
    EXPECT_NEAR((*back.source().read)[3 * 30 + t], 100 + 10.0 * double(t) + 0.01 * degrees_per_radian, 1e-5);
}

TEST(BvhWrite, GoesOnFromThePreviousFrameWhereTheFramesAreOthers) {
  std::string text = "Frames: 40\nFrame Time: 0.04\n";
  for (int t = 0; t < 40; ++t) text += "0 0 0 " + std::to_string(17 * t - 300) + " 20 30 0 0 0\n";
  const Motion motion = read(small_bvh(text));
  Motion cut = motion.empty_like(39);
  for (int j = 0; j < 2; ++j)
    for (std::size_t t = 0; t < 39; ++t) cut.rotation(j).set(t, motion.rotation(j)[t + 1]);
  const Motion back = read(written(cut));
  const double* z = back.source().read->data() + 3 * 39;
  for (std::size_t t = 1; t < 39; ++t) EXPECT_NEAR(z[t] - z[t - 1], 17, 1e-5);
}

TEST(BvhWrite, AddsPositionChannelsOnlyWhereATranslationVaries) {
  Motion motion = read(small_bvh(two_frames())).with_translation(1);
  EXPECT_EQ(read(written(motion)).source().bvh[1].channels.size(), 3u);
  motion.translation(1).set(1, {0, -1, 0.1});
  const Motion back = read(written(motion));
  EXPECT_EQ(back.source().bvh[1].channels.size(), 6u);
  EXPECT_EQ(back.source().bvh[0].channels, motion.source().bvh[0].channels);
  EXPECT_LT(largest_distance(motion, back), 2e-6);

  WriteOptions options;
  options.stretch = "drop";
  EXPECT_EQ(read(written(motion, options)).source().bvh[1].channels.size(), 3u);
  options.stretch = "error";
  try {
    written(motion, options);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "stretch");
    EXPECT_EQ(failure.diagnostic().joint, "Leg");
    EXPECT_EQ(failure.diagnostic().frame, 1);
  }
}

TEST(BvhWrite, AddsRotationChannelsWhereTooFewHoldTheTurn) {
  const std::string text = small_bvh("Frames: 2\nFrame Time: 0.04\n10\n20\n", "0", "1 Xrotation");
  Motion motion = read(text);
  EXPECT_EQ(read(written(motion)).source().bvh[1].channels.size(), 1u);
  EXPECT_EQ(read(written(motion)).source().bvh[0].channels.size(), 0u);
  motion.rotation(1).set(1, axis_angle({1, 0, 0}, 0.5));  // its one channel still holds that
  EXPECT_EQ(read(written(motion)).source().bvh[1].channels.size(), 1u);
  motion.rotation(1).set(1, axis_angle({0, 1, 0}, 0.5));
  motion.rotation(0).set(1, axis_angle({0, 0, 1}, 0.5));
  const Motion back = read(written(motion));
  EXPECT_EQ(back.source().bvh[1].channels.size(), 3u);
  for (int j = 0; j < 2; ++j) EXPECT_LT(turn(back.rotation(j)[1], motion.rotation(j)[1]), 1e-7);
}

TEST(BvhWrite, TakesTheWantedUnitOrderAndPrecision) {
  const Motion motion = read(small_bvh(two_frames()));
  WriteOptions options;
  options.unit = Json("cm");
  options.euler = "XYZ";
  options.precision = 9;
  const std::string text = written(motion, options);
  EXPECT_NE(text.find("OFFSET 0 -80 10"), std::string::npos) << text;
  EXPECT_NE(text.find("Xrotation Yrotation Zrotation"), std::string::npos);
  EXPECT_NE(text.find("\n100.000000000 200.000000000 300.000000000 "), std::string::npos);
  const Motion back = read(text, "cm");
  EXPECT_LT(largest_distance(motion, back), 1e-9);
}

TEST(BvhWrite, KeepsTheAxisThatPointedUp) {
  Alone work;
  ReadOptions options;
  options.unit = Json("m");
  options.up = "z";
  const Motion motion = read_bvh(small_bvh(two_frames()), options, work);
  EXPECT_EQ(written(motion), written(read(small_bvh(two_frames()))));
}

TEST(BvhWrite, HasADefaultLayoutForWhatCameFromNoBvh) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  PlainFiles files;
  for (const char* clip : {"cmu/asfamc/16_45.amc", "cmu/asfamc/141_01.amc"}) {
    const MotionFile file = read_motion_file(mocap(clip), {}, files, work);
    const Motion& motion = *file.motion();
    const std::string text = written(motion);
    EXPECT_NE(text.find("CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n"),
              std::string::npos);
    const Motion back = read(text, Json(motion.source().unit));
    ASSERT_EQ(back.frames(), motion.frames());
    EXPECT_EQ(back.fps(), 120);
    EXPECT_LT(largest_distance(motion, back), 1e-6);
  }
}

// A rest pose with turns (glTF) becomes one without; the joints stay where they were.
TEST(BvhWrite, KeepsWorldPositionsOfASkeletonWithRestTurns) {
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->above = axis_angle({1, 0, 0}, 0.7);
  skeleton->above_offset = {0.1, 0.2, 0.3};
  skeleton->above_scale = 1.5;
  skeleton->joints = {{"a", -1, {0, 1, 0}, axis_angle({0, 1, 0}, 0.4)},
                      {"b", 0, {0.3, 0.1, 0}, axis_angle({0, 0, 1}, -1.1)},
                      {"d", 0, {-0.3, 0.1, 0}, axis_angle({1, 0, 0}, 0.3)},
                      {"c", 1, {0, 0.4, 0.1}, {}}};  // not depth first
  Motion motion(skeleton, nullptr, 30, 5, {true, false, false, true});
  for (int j = 0; j < 4; ++j)
    for (std::size_t t = 0; t < 5; ++t)
      motion.rotation(j).set(
          t, axis_angle(normalized(Vec3{1.0, double(j), 0.5}), 0.3 * double(t)) * skeleton->joints[j].rest);
  for (std::size_t t = 0; t < 5; ++t) motion.translation(0).set(t, {double(t), 1, 0});
  motion.translation(3).set(2, {0, 0.6, 0.1});
  const Motion back = read(written(motion));
  EXPECT_EQ(back.joints(), 4);
  EXPECT_LT(largest_distance(motion, back), 1e-5);
  for (const Joint& joint : back.skeleton().joints) EXPECT_EQ(joint.rest, Quat{});
  // At rest the new skeleton is the old one.
  const RestPose was = rest_pose(*skeleton), is = rest_pose(back.skeleton());
  for (int j = 0; j < 4; ++j)
    EXPECT_LT(norm(was.positions[j] - is.positions[back.skeleton().find(skeleton->joints[j].name)]), 1e-6);
}

TEST(BvhWrite, RefusesNumbersThatAreNotFinite) {
  Motion motion = read(small_bvh(two_frames()));
  motion.rotation(1).x[1] = NAN;
  try {
    written(motion);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "not-finite");
    EXPECT_EQ(failure.diagnostic().joint, "Leg");
    EXPECT_EQ(failure.diagnostic().frame, 1);
  }
}

}  // namespace
}  // namespace kinegraph
