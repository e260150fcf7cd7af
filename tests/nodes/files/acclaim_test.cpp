#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/files/acclaim_motion.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

const std::string asf =
    ":version 1.10\n:units\n  mass 1.0\n  length 0.45\n  angle deg\n:root\n   order TX TY TZ RX RY RZ\n   "
    "axis XYZ\n"
    "   position 0 1 0\n   orientation 0 0 0\n:bonedata\n  begin\n    id 1\n    name thigh\n    direction 0 "
    "-1 0\n"
    "    length 7\n    axis 0 0 90 XYZ\n    dof rx rz\n    limits (-160.0 20.0)\n           (-70.0 70.0)\n  "
    "end\n  begin\n"
    "    id 2\n    name shin\n    direction 0 -2 0\n    length 6\n    axis 0 0 0 XYZ\n    dof rx\n  "
    "end\n:hierarchy\n  begin\n"
    "    root thigh\n    thigh shin\n  end\n";
const std::string amc =
    "#!OML:ASF F:\\elsewhere.ASF\n:FULLY-SPECIFIED\n:DEGREES\n1\nroot 1 2 3 10 20 30\nthigh 40 50\nshin 60\n"
    "2\nroot 1 2 3 10 20 30\nthigh 40 50\nshin 61\n";

MotionFile load(const std::string& skeleton, const std::string& motion, ReadOptions options = {},
                Alone* told = nullptr) {
  PlainFiles files;
  files.made = {{"/clip.asf", skeleton}, {"/clip.amc", motion}};
  Alone work;
  return read_motion_file("/clip.amc", options, files, told ? *told : work);
}
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(Acclaim, TurnsEachBoneInItsOwnAxes) {
  const MotionFile file = load(asf, amc);
  const Motion& motion = *file.motion();
  ASSERT_EQ(motion.joints(), 3);
  ASSERT_EQ(motion.frames(), 2u);
  const double degree = pi / 180, unit = 0.0254 / 0.45;
  auto about = [&](int axis, double degrees) {
    Vec3 v;
    v[axis] = 1;
    return axis_angle(v, degrees * degree);
  };
  const Quat c = about(2, 90);
  EXPECT_LT(turn(motion.rotation(0)[0], about(2, 30) * about(1, 20) * about(0, 10)), 1e-7);
  EXPECT_LT(turn(motion.rotation(1)[0], c * about(2, 50) * about(0, 40) * inverse(c)), 1e-7);
  EXPECT_LT(turn(motion.rotation(2)[1], about(0, 61)), 1e-7);
  EXPECT_LT(norm(motion.translation(0)[0] - unit * Vec3{1, 3, 3}), 1e-12);
  EXPECT_LT(norm(motion.skeleton().joints[1].offset), 1e-12);                          // at the root
  EXPECT_LT(norm(motion.skeleton().joints[2].offset - unit * Vec3{0, -7, 0}), 1e-12);  // at the thigh's end
  ASSERT_EQ(motion.skeleton().ends.size(), 1u);
  EXPECT_LT(norm(motion.skeleton().ends[0].offset - unit * Vec3{0, -6, 0}), 1e-12);
  EXPECT_EQ(motion.source().unit_name, "cmu");
}

TEST(Acclaim, TakesRadiansRatesLineEndsAndAnyOrderOfBones) {
  ReadOptions options;
  options.rate = 60;
  std::string crlf;
  for (char c : amc) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  const MotionFile plain = load(asf, amc), other = load(asf, crlf, options);
  EXPECT_EQ(other.motion()->fps(), 60);
  EXPECT_EQ(other.motion()->rotation(1)[0], plain.motion()->rotation(1)[0]);
  const std::string swapped = replaced(amc, "thigh 40 50\nshin 60\n", "shin 60\nthigh 40 50\n");
  EXPECT_EQ(load(asf, swapped).motion()->rotation(1)[0], plain.motion()->rotation(1)[0]);
  const std::string radians =
      replaced(replaced(amc, ":DEGREES", ":RADIANS"), "shin 60", "shin 1.0471975511965976");
  EXPECT_LT(turn(load(asf, radians).motion()->rotation(2)[0], plain.motion()->rotation(2)[0]), 1e-7);
}

TEST(Acclaim, AloneIsASkeletonWithoutFrames) {
  PlainFiles files;
  files.made = {{"/clip.asf", asf}};
  Alone work;
  const MotionFile file = read_motion_file("/clip.asf", {}, files, work);
  EXPECT_EQ(file.motion()->frames(), 0u);
  EXPECT_EQ(file.motion()->joints(), 3);
}

struct Mistake {
  bool in_asf;
  const char *what, *by, *code;
  int line, column;
};
TEST(Acclaim, RefusesWithFileLineColumnAndReason) {
  const Mistake mistakes[] = {
      {false, "thigh 40 50", "thihg 40 50", "unknown-bone", 6, 1},
      {false, "thigh 40 50", "thigh 40", "too-few-values", 6, 9},
      {false, "thigh 40 50", "thigh 40 50 60", "too-many-values", 6, 13},
      {false, "thigh 40 50", "thigh 40 nan", "not-finite", 6, 10},
      {false, "thigh 40 50", "thigh 40,5 50", "decimal-comma", 6, 7},
      {false, "thigh 40 50\n", "", "missing-bone", 4, 1},
      {false, "thigh 40 50\n", "thigh 40 50\nthigh 40 50\n", "duplicate-bone", 7, 1},
      {false, "\n1\n", "\n1x\n", "bad-frame-number", 4, 1},
      {true, "length 7", "length seven", "bad-asf", 16, 12},
      {true, "    length 7\n", "", "bad-asf", 12, 3},
      {true, "dof rx rz", "dof rx rq", "bad-asf", 18, 12},
      {true, "thigh shin", "thigh shim", "bad-asf", 33, 11},
      {true, "    thigh shin\n", "", "bad-asf", 22, 3},
      {true, "axis 0 0 90 XYZ", "axis 0 0 90 XXZ", "bad-asf", 17, 17},
      {true, ":version", "version", "not-an-asf", 1, 1},
  };
  for (const Mistake& mistake : mistakes) {
    try {
      load(mistake.in_asf ? replaced(asf, mistake.what, mistake.by) : asf,
           mistake.in_asf ? amc : replaced(amc, mistake.what, mistake.by));
      ADD_FAILURE() << mistake.by;
    } catch (const Failure& failure) {
      const Diagnostic& problem = failure.diagnostic();
      EXPECT_EQ(problem.code, mistake.code) << mistake.by << ": " << problem.message;
      EXPECT_EQ(problem.place.line, mistake.line) << mistake.by << ": " << problem.message;
      EXPECT_EQ(problem.place.column, mistake.column) << mistake.by << ": " << problem.message;
      EXPECT_EQ(problem.file, mistake.in_asf ? "/clip.asf" : "/clip.amc");
    }
  }
}

TEST(Acclaim, FindsTheSkeletonBesideTheMotion) {
  PlainFiles files;
  files.made = {{"/a/16_45.asf", ""}, {"/a/16.asf", ""}, {"/b/16.asf", ""}, {"/b/2.asf", ""},
                {"/c/other.asf", ""}, {"/d/1.asf", ""},  {"/d/2.asf", ""}};
  EXPECT_EQ(find_asf("/a/16_45.amc", files), "/a/16_45.asf");
  EXPECT_EQ(find_asf("/b/16_45.amc", files), "/b/16.asf");
  EXPECT_EQ(find_asf("/c/16_45.amc", files), "/c/other.asf");
  try {
    find_asf("/d/16_45.amc", files);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "missing-skeleton");
    EXPECT_EQ(failure.diagnostic().param, "skeleton");
    for (const char* tried : {"16_45.asf", "16.asf", "2"})
      EXPECT_NE(failure.diagnostic().message.find(tried), std::string::npos) << failure.diagnostic().message;
  }
}

TEST(Acclaim, TellsOfFrameNumbersThatSkip) {
  Alone told;
  load(asf, replaced(amc, "\n2\n", "\n7\n"), {}, &told);
  EXPECT_TRUE(std::any_of(told.reported.begin(), told.reported.end(),
                          [](const Diagnostic& one) { return one.code == "skipped-frame-numbers"; }));
}

}  // namespace
}  // namespace kinegraph
