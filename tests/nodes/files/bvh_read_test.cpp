#include "nodes/files/bvh_read.h"

#include <gtest/gtest.h>

#include "nodes/files/channel_rotations.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/files/bvh_texts.h"

namespace kinegraph {
namespace {

Motion read(const std::string& text, ReadOptions options = {}) {
  Alone work;
  return read_bvh(text, options, work);
}
ReadOptions in_metres() {
  ReadOptions options;
  options.unit = Json("m");
  return options;
}
Diagnostic problem_of(const std::string& text, const ReadOptions& options = {}) {
  try {
    read(text, options);
  } catch (const Failure& failure) {
    return failure.diagnostic();
  }
  ADD_FAILURE() << "it loaded";
  return {};
}
void expect_near(Vec3 a, Vec3 b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}
std::string codes_of(const std::string& text) {
  Alone work;
  read_bvh(text, {}, work);
  std::string codes;
  for (const auto& one : work.reported)
    if (one.severity == Severity::warning) codes += (codes.empty() ? "" : " ") + one.code;
  return codes;
}
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

TEST(BvhRead, TurnsChannelsInTheirOrder) {
  const Motion motion = read(small_bvh(two_frames()), in_metres());
  ASSERT_EQ(motion.frames(), 2u);
  EXPECT_EQ(motion.fps(), 25);
  const double degree = pi / 180;
  const Quat expected = axis_angle({0, 0, 1}, 10 * degree) * axis_angle({0, 1, 0}, 20 * degree) *
                        axis_angle({1, 0, 0}, 30 * degree);
  EXPECT_LT(turn(motion.rotation(0)[0], expected), 1e-12);
  expect_near(motion.translation(0)[1], {1.5, 2, 3});
  EXPECT_EQ(motion.skeleton().joints[1].name, "Leg");
  expect_near(motion.skeleton().joints[1].offset, {0, -0.8, 0.1});
  ASSERT_EQ(motion.skeleton().ends.size(), 1u);
  expect_near(motion.skeleton().ends[0].offset, {0, -0.9, 0});
  EXPECT_FALSE(motion.translates(1));
}

TEST(BvhRead, TakesAnyOrderAndNumberOfChannels) {
  const std::string motion = "Frames: 1\nFrame Time: 0.04\n30 1 10 2 5 6 7 8\n";
  const Motion read_motion = read(small_bvh(motion, "4 Xrotation Zposition Yrotation Yposition",
                                            "4 Xrotation Yrotation Xrotation Zrotation"),
                                  in_metres());
  const double degree = pi / 180;
  const Quat root = axis_angle({1, 0, 0}, 30 * degree) * axis_angle({0, 1, 0}, 10 * degree);
  const Quat leg = axis_angle({1, 0, 0}, 5 * degree) * axis_angle({0, 1, 0}, 6 * degree) *
                   axis_angle({1, 0, 0}, 7 * degree) * axis_angle({0, 0, 1}, 8 * degree);
  EXPECT_LT(turn(read_motion.rotation(0)[0], root), 1e-12);
  EXPECT_LT(turn(read_motion.rotation(1)[0], leg), 1e-12);
  expect_near(read_motion.translation(0)[0], {0, 2, 1});
}

TEST(BvhRead, LetsPositionChannelsReplaceTheOffset) {
  const std::string six = "6 Xposition Yposition Zposition Zrotation Yrotation Xrotation";
  const std::string head = "Frames: 2\nFrame Time: 0.04\n";
  const Motion moving =
      read(small_bvh(head + "0 0 0 0 0 0 0 -1 0 0 0 0\n0 0 0 0 0 0 0 -1.5 0 0 0 0\n", six, six), in_metres());
  ASSERT_TRUE(moving.translates(1));
  expect_near(moving.translation(1)[1], {0, -1.5, 0});
  expect_near(moving.skeleton().joints[1].offset, {0, -0.8, 0.1});
  // Standing still at the OFFSET is no track; standing still elsewhere is one.
  EXPECT_FALSE(
      read(small_bvh(head + "0 0 0 0 0 0 0 -0.8 0.1 0 0 0\n1 0 0 0 0 0 0 -0.8 0.1 0 0 0\n", six, six),
           in_metres())
          .translates(1));
  EXPECT_TRUE(
      read(small_bvh(head + "0 0 0 0 0 0 0 0 0 0 0 0\n1 0 0 0 0 0 0 0 0 0 0 0\n", six, six), in_metres())
          .translates(1));
}

TEST(BvhRead, TakesOddSpellings) {
  const std::string plain = small_bvh(two_frames());
  const Motion expected = read(plain, in_metres());
  const std::string variants[] = {
      "\xEF\xBB\xBF" + replaced(plain, "\n", "\r\n"),
      replaced(plain, "\t", "   "),
      replaced(replaced(replaced(plain, "HIERARCHY", "hierarchy"), "JOINT", "joint"), "End Site", "END SITE"),
      replaced(replaced(plain, "Xposition", "xposition"), "Zrotation", "ZROTATION"),
      replaced(plain, "ROOT Hips\n{", "ROOT Hips {"),
      replaced(plain, "1 2 3 10 20 30 ", "1 2 3\n10 20 30\n"),  // a frame on several lines
      replaced(plain, "Frames: 2", "Frames:2"),
      replaced(plain, " 10 ", "\t+10.0e0  "),
      plain.substr(0, plain.size() - 1),  // no final newline
      plain + "\n\n  \n",
      replaced(plain, "\n", "\r"),
  };
  for (const std::string& text : variants) {
    const Motion motion = read(text, in_metres());
    ASSERT_EQ(motion.frames(), expected.frames()) << text;
    EXPECT_EQ(*motion.source().read, *expected.source().read) << text;
    EXPECT_EQ(motion.source().bvh[0].channels, expected.source().bvh[0].channels);
  }
}

TEST(BvhRead, KeepsNamesWithBlanksAndMakesDoublesUnique) {
  const Motion motion = read(replaced(small_bvh(two_frames()), "JOINT Leg", "JOINT Left Upper.Leg:2 #"));
  EXPECT_EQ(motion.skeleton().joints[1].name, "Left Upper.Leg:2 #");
  EXPECT_EQ(read(replaced(small_bvh(two_frames()), "JOINT Leg", "JOINT Hips")).skeleton().joints[1].name,
            "Hips_2");
  EXPECT_EQ(codes_of(replaced(small_bvh(two_frames()), "JOINT Leg", "JOINT Hips")), "duplicate-joint");
  EXPECT_EQ(
      read(replaced(small_bvh(two_frames()), "JOINT Leg", "JOINT \xE8\x85\xB0")).skeleton().joints[1].name,
      "\xE8\x85\xB0");
  EXPECT_EQ(read(replaced(small_bvh(two_frames()), "JOINT Leg", "JOINT L\xE9g")).skeleton().joints[1].name,
            "L\xC3\xA9g");
}

TEST(BvhRead, SplitsGluedNumbersAtTheSign) {
  const std::string text = replaced(small_bvh(two_frames()), "30 -5 6", "30-5 6");
  EXPECT_EQ(codes_of(text), "glued-numbers");
  EXPECT_EQ(*read(text).source().read, *read(small_bvh(two_frames())).source().read);
}

TEST(BvhRead, LeavesOutFramesPastTheAnnounced) {
  EXPECT_EQ(codes_of(replaced(small_bvh(two_frames()), "Frames: 2", "Frames: 1")), "more-frames");
  EXPECT_EQ(read(replaced(small_bvh(two_frames()), "Frames: 2", "Frames: 1")).frames(), 1u);
}

struct Mistake {
  const char* what;
  const char* by;
  const char* code;
  int line, column;
};
TEST(BvhRead, RefusesWithLineColumnAndReason) {
  const Mistake mistakes[] = {
      {"HIERARCHY", "SKELETON", "not-a-bvh", 1, 1},
      {"ROOT Hips", "ROOTS Hips", "bad-hierarchy", 2, 1},
      {"MOTION", "ROOT Other\n{\n}\nMOTION", "several-roots", 16, 1},
      {"MOTION", "", "bad-hierarchy", 17, 1},
      {"OFFSET 0 -0.8 0.1", "OFFSET 0 -0,8 0.1", "decimal-comma", 8, 12},
      {"OFFSET 0 -0.8 0.1", "OFFSET 0 x 0.1", "bad-number", 8, 12},
      {"OFFSET 0 -0.8 0.1", "", "bad-hierarchy", 14, 2},
      {"CHANNELS 3 Z", "CHANNELS 3 Q", "bad-channel", 9, 14},
      {"CHANNELS 3 Z", "CHANNELS 4 Z", "bad-channel", 10, 3},
      {"Frames: 2", "Frames: two", "bad-frames", 17, 9},
      {"Frames: 2", "Frames: -2", "bad-frames", 17, 9},
      {"Frames: 2", "Frames: 3", "too-few-frames", 21, 1},
      {"Frames: 2", "Frames: 900000000000", "too-few-frames", 21, 1},
      {"Frame Time: 0.04", "Frame Time: 0", "bad-frame-time", 18, 13},
      {"Frame Time: 0.04", "Frame Time: -0.04", "bad-frame-time", 18, 13},
      {"Frame Time: 0.04", "Frame Time: nan", "bad-frame-time", 18, 13},
      {"31 -6 7 8", "31 -6 7", "too-few-values", 20, 22},
      {"30 -5 6 7", "30 -5 6 7 8", "too-many-values", 19, 23},
      {"30 -5 6 7", "30 -5 6", "too-few-values", 19, 20},
      {"11 21 31", "11 nan 31", "not-finite", 20, 12},
      {"11 21 31", "11 1.#QNAN 31", "not-finite", 20, 12},
      {"11 21 31", "11 21,5 31", "decimal-comma", 20, 12},
      {"11 21 31", "11 x 31", "bad-number", 20, 12},
      {"11 21 31", "11 1e999 31", "bad-number", 20, 12},
  };
  for (const Mistake& mistake : mistakes) {
    const Diagnostic problem = problem_of(replaced(small_bvh(two_frames()), mistake.what, mistake.by));
    EXPECT_EQ(problem.code, mistake.code) << mistake.by << ": " << problem.message;
    EXPECT_EQ(problem.place.line, mistake.line) << mistake.by << ": " << problem.message;
    EXPECT_EQ(problem.place.column, mistake.column) << mistake.by << ": " << problem.message;
  }
  const Diagnostic large = problem_of(replaced(small_bvh(two_frames()), "11 21 31", "11 1e30 31"));
  EXPECT_EQ(large.code, "too-large");
  EXPECT_EQ(large.joint, "Hips");
  EXPECT_EQ(large.frame, 1);
}

TEST(BvhRead, CutsToTheRangeInTheFilesFrames) {
  std::string text = "Frames: 5\nFrame Time: 0.04\n";
  for (int t = 0; t < 5; ++t) text += std::to_string(t) + " 0 0 0 0 0 0 0 0\n";
  ReadOptions options = in_metres();
  options.range = {1, 4};
  EXPECT_EQ(read(small_bvh(text), options).frames(), 3u);
  EXPECT_EQ(read(small_bvh(text), options).translation(0)[0].x, 1);
  options.range = {0, 3};
  options.drop_rest_frame = true;
  EXPECT_EQ(read(small_bvh(text), options).frames(), 2u);
  EXPECT_EQ(read(small_bvh(text), options).translation(0)[0].x, 1);
  for (FrameRange range :
       {FrameRange{5, {}}, FrameRange{2, 2}, FrameRange{0, 6}, FrameRange{-1, 3}, FrameRange{0, 1}}) {
    options.range = range;
    EXPECT_EQ(problem_of(small_bvh(text), options).code, "bad-range");
  }
}

TEST(BvhRead, FindsTheUnitThatBringsThePersonNearestToItsHeight) {
  Alone work;
  const Motion metres = read_bvh(small_bvh(two_frames()), {}, work);
  EXPECT_EQ(metres.source().unit_name, "m");
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "unit-found");
  EXPECT_EQ(work.reported[0].severity, Severity::info);
  const std::string cm = replaced(replaced(small_bvh(two_frames()), "-0.8", "-80"), "-0.9", "-90");
  EXPECT_EQ(read(cm).source().unit_name, "cm");
  ReadOptions options;
  options.unit = Json(0.5);
  EXPECT_EQ(read(cm, options).source().unit, 0.5);
  EXPECT_NEAR(read(cm, options).skeleton().ends[0].offset.y, -45, 1e-12);
}

// Bones along x, each turned into its place by its channels: at rest hips 100 up, legs and trunk sideways.
std::string rig_along_x(const std::string& frames) {
  const std::string turns = "\nCHANNELS 3 Zrotation Yrotation Xrotation\n";
  return "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation "
         "Yrotation Xrotation\nJOINT Leg\n{\nOFFSET 0 -60 0" +
         turns + "End Site\n{\nOFFSET 70 0 0\n}\n}\nJOINT Chest\n{\nOFFSET 0 40 0" + turns +
         "End Site\n{\nOFFSET 45 0 0\n}\n}\n}\nMOTION\n" + frames;
}

TEST(BvhRead, TakesTheFirstFramesHeightWhereTheRestPoseIsNone) {
  // Leg down, trunk up: 215 high; at rest 100, which would be 2.5 m in inches.
  const std::string stands = "0 0 0 0 0 0 -90 0 0 90 0 0\n";
  const std::string falls = "0 0 0 90 0 0 0 0 0 0 0 0\n";
  const std::string rig = rig_along_x("Frames: 3\nFrame Time: 0.04\n" + stands + falls + falls);
  Alone work;
  EXPECT_EQ(read_bvh(rig, {}, work).source().unit_name, "cm");
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_NE(work.reported[0].message.find("the first frame is 215 units high"), std::string::npos)
      << work.reported[0].message;
  // The file's first frame, whichever are kept.
  ReadOptions options;
  options.range = {1, 3};
  EXPECT_EQ(read(rig, options).source().unit_name, "cm");
  options.range = {};
  options.drop_rest_frame = true;
  EXPECT_EQ(read(rig, options).source().unit_name, "cm");
}

TEST(BvhRead, TakesTheLengthOfAFigureThatLiesForItsHeight) {
  Alone work;
  const std::string still = "Frames: 1\nFrame Time: 0.04\n1 2 3 0 0 0 0 0 5\n";
  const std::string lies =
      replaced(replaced(small_bvh(still), "0 -0.8 0.1", "0 0.1 -80"), "0 -0.9 0", "0 0 -90");
  EXPECT_EQ(read_bvh(lies, {}, work).source().unit_name, "cm");
  EXPECT_NE(work.reported[0].message.find("lies along Z"), std::string::npos) << work.reported[0].message;
  ReadOptions options;
  options.up = "z";
  EXPECT_EQ(read(lies, options).source().unit_name, "cm");
}

TEST(BvhRead, TurnsAFileWhoseZPointsUp) {
  ReadOptions options = in_metres();
  const Motion as_written = read(small_bvh(two_frames()), options);
  options.up = "z";
  const Motion turned = read(small_bvh(two_frames()), options);
  const Pose a = pose_at(as_written, 1), b = pose_at(turned, 1);
  for (std::size_t j = 0; j < 2; ++j)
    expect_near(b.positions[j], {a.positions[j].y, a.positions[j].z, a.positions[j].x});
}

TEST(BvhRead, KeepsQuaternionsContinuousOverWraps) {
  std::string text = "Frames: 40\nFrame Time: 0.04\n";
  for (int t = 0; t < 40; ++t) text += "0 0 0 0 " + std::to_string((t * 25 + 180) % 360 - 180) + " 0 0 0 0\n";
  const Motion motion = read(small_bvh(text));
  for (std::size_t t = 1; t < 40; ++t) EXPECT_GT(dot(motion.rotation(0)[t], motion.rotation(0)[t - 1]), 0.9);
}

TEST(ChannelRotations, AreThoseOfTheEulerAnglesForEveryNumberOfFrames) {
  for (std::size_t frames = 1; frames < 20; ++frames) {
    std::vector<double> x(frames), y(frames), z(frames), out(4 * frames);
    for (std::size_t t = 0; t < frames; ++t) {
      x[t] = 37.5 * double(t) - 400;
      y[t] = -190 + 91 * double(t);
      z[t] = 720 - 45 * double(t);
    }
    std::span<double> all(out);
    QuatTrack q{all.subspan(0, frames), all.subspan(frames, frames), all.subspan(2 * frames, frames),
                all.subspan(3 * frames, frames)};
    const double* channels[] = {z.data(), x.data(), y.data()};
    rotations_from_degrees("ZXY", channels, q);
    for (std::size_t t = 0; t < frames; ++t) {
      const double radians[] = {z[t] / degrees_per_radian, x[t] / degrees_per_radian,
                                y[t] / degrees_per_radian};
      EXPECT_LT(turn(q[t], from_euler("ZXY", radians)), 1e-7);  // turn() loses half the digits near zero
      EXPECT_NEAR(dot(q[t], q[t]), 1, 1e-14);
      EXPECT_GT(std::fabs(dot(q[t], from_euler("ZXY", radians))), 1 - 1e-14);
    }
  }
}

}  // namespace
}  // namespace kinegraph
