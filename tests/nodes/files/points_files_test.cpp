// TRC, CSV and C3D: what they must read, refuse, and give back.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "nodes/files/bvh_write.h"
#include "nodes/files/c3d.h"
#include "nodes/files/motion_file.h"
#include "nodes/files/points_table.h"
#include "nodes/files/trc.h"
#include "nodes/motion/kinematics.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

ReadOptions unfilled() {
  ReadOptions options;
  options.max_gap = 0;
  return options;
}

Points load(const std::string& file, ReadOptions options = {}) {
  PlainFiles files;
  Alone work;
  return *read_motion_file(mocap(file), options, files, work).points();
}

std::string codes(const Alone& work) {
  std::string all;
  for (const Diagnostic& one : work.reported)
    if (one.severity == Severity::warning) all += (all.empty() ? "" : " ") + one.code;
  return all;
}

template <class Body>
Diagnostic refusal(Body body) {
  try {
    body();
  } catch (const Failure& failure) {
    return failure.diagnostic();
  }
  return info("done", "");
}

// Two markers, four frames, the second marker missing in frame 2; coordinates that no float32 holds.
Points two_markers() {
  Points points({"Chest", "a:b c"}, 59.94, 4);
  for (std::size_t t = 0; t < 4; ++t) {
    points.track(0).set(t, {0.1 + 0.3 * double(t), 1.0 / 3, -0.7});
    points.track(1).set(t, {1e-9, -12.5 + double(t * t), 0.1 * double(t)});
  }
  points.set_missing(1, 2);
  return points;
}

void expect_same(const Points& a, const Points& b, double tolerance) {
  ASSERT_EQ(a.labels, b.labels);
  ASSERT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.fps, b.fps);
  for (int label = 0; label < int(a.labels.size()); ++label)
    for (std::size_t t = 0; t < a.frames; ++t) {
      ASSERT_EQ(a.is_missing(label, t), b.is_missing(label, t)) << a.labels[label] << " " << t;
      const Vec3 p = a.track(label)[t], q = b.track(label)[t];
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(p[axis], q[axis], tolerance * std::max(1.0, std::fabs(p[axis])))
            << a.labels[label] << " " << t;
    }
}

std::string trc_text(const std::string& rows, const char* frames = "3", const char* unit = "mm",
                     const char* rate = "100") {
  return std::string(
             "PathFileType\t4\t(X/Y/Z)\tx.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n") +
         rate + "\t100\t" + frames + "\t2\t" + unit +
         "\nFrame#\tTime\tA\t\t\tB\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n" + rows;
}
const char* const three_rows =
    "1\t0.00\t1\t2\t3\t4\t5\t6\n"
    "2\t0.01\t\t\t\tNaN\tnan\tNAN\n"
    "3\t0.02\t7\t8\t9\t10\t11\t12\n";

TEST(Trc, IsReadInMetresWithMissingMarkersAndAnyLineEnds) {
  Alone work;
  const std::string text = trc_text(three_rows);
  const Points points = read_trc(text, unfilled(), work);
  EXPECT_EQ(points.labels, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(points.fps, 100);
  ASSERT_EQ(points.frames, 3u);
  EXPECT_NEAR(points.track(1)[2].z, 0.012, 1e-15);
  EXPECT_TRUE(points.is_missing(0, 1) && points.is_missing(1, 1));
  EXPECT_FALSE(points.is_missing(0, 0));
  std::string crlf;
  for (char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(encoded(read_trc(crlf, unfilled(), work)), encoded(points));
}

TEST(Trc, ConvertsItsUnitAndUpAxis) {
  Alone work;
  ReadOptions options = unfilled();
  options.up = "z";
  const Points points = read_trc(trc_text(three_rows, "3", "cm"), options, work);
  EXPECT_NEAR(norm(points.track(0)[0] - Vec3{0.02, 0.03, 0.01}), 0, 1e-15);
  options.unit = 2.0;
  EXPECT_NEAR(read_trc(trc_text(three_rows, "3", "furlong"), options, work).track(0)[0].x, 4, 1e-15);
}

TEST(Trc, TakesTheRateOfItsTimesWhereDataRateDiffers) {
  Alone work;
  EXPECT_EQ(read_trc(trc_text(three_rows, "3", "mm", "1000"), unfilled(), work).fps, 100);
  EXPECT_EQ(codes(work), "rate-differs long-gap");
}

TEST(Trc, IsRefusedWhereItIsDamaged) {
  Alone work;
  auto code = [&](const std::string& text) { return refusal([&] { read_trc(text, unfilled(), work); }); };
  const std::string whole = trc_text(three_rows);
  EXPECT_EQ(code(whole.substr(0, 60)).code, "truncated");
  EXPECT_EQ(code(trc_text(three_rows, "4")).code, "truncated");
  EXPECT_EQ(code(trc_text(three_rows, "2")).code, "too-many-frames");
  EXPECT_EQ(code(trc_text(three_rows, "3", "furlong")).code, "unknown-unit");
  const Diagnostic few = code(trc_text("1\t0\t1\t2\t3\t4\t5\n", "1"));
  EXPECT_EQ(few.code, "too-few-values");
  EXPECT_EQ(few.place.line, 7);
  const Diagnostic word = code(trc_text("1\t0\t1\t2\t3,5\t4\t5\t6\n", "1"));
  EXPECT_EQ(word.code, "decimal-comma");
  EXPECT_EQ(word.place.column, 9);
  EXPECT_EQ(code(trc_text("1\t0\t1\t2\tinf\t4\t5\t6\n", "1")).code, "bad-number");
}

TEST(Trc, GoesRoundWithinItsDigitsAndSecondTimeExactly) {
  Alone work;
  Points points = two_markers();
  points.unit = 0.001;
  points.unit_name = "mm";
  const std::string text = write_trc(points, "x.trc", {}, work);
  const Points back = read_trc(text, unfilled(), work);
  expect_same(back, points, 0.5e-9);
  EXPECT_EQ(write_trc(back, "x.trc", {}, work), text);
}

TEST(PointsTable, ReadsEveryNumberBackExactly) {
  Alone work;
  const Points points = two_markers();
  const std::string text = write_points_table(points, work);
  EXPECT_EQ(text.substr(0, text.find('\n')), "frame,time,Chest.x,Chest.y,Chest.z,a:b c.x,a:b c.y,a:b c.z");
  EXPECT_NE(text.find(",,,\n"), std::string::npos);  // the missing sample
  const Points back = read_points_table(text, unfilled(), work);
  EXPECT_EQ(encoded(back), encoded(points));
}

TEST(PointsTable, OfOthersIsReadToo) {
  Alone work;
  ReadOptions options = unfilled();
  options.rate = 50;
  const Points points = read_points_table("A_x;A_y;A_z\r\n1;2;3\r\n4;;6\r\n", options, work);
  EXPECT_EQ(points.fps, 50);
  EXPECT_EQ(points.labels, std::vector<std::string>{"A"});
  EXPECT_EQ(points.track(0)[0], (Vec3{1, 2, 3}));
  EXPECT_TRUE(points.is_missing(0, 1));
  EXPECT_EQ(codes(work), "unit-unknown long-gap");
}

TEST(PointsTable, IsRefusedWhereItIsNone) {
  Alone work;
  auto code = [&](const char* text) { return refusal([&] { read_points_table(text, {}, work); }).code; };
  EXPECT_EQ(code(""), "bad-header");
  EXPECT_EQ(code("a,b\n1,2\n"), "bad-header");
  EXPECT_EQ(code("A.x,A.y\n1,2\n"), "bad-header");
  EXPECT_EQ(code("A.x,A.y,A.z,A.x\n"), "bad-header");
  EXPECT_EQ(code("A.x,A.y,A.z\n1,2\n"), "too-few-values");
  EXPECT_EQ(code("A.x,A.y,A.z\n1,2,3,4\n"), "too-many-values");
  EXPECT_EQ(code("A.x,A.y,A.z\n1,2,x\n"), "bad-number");
  EXPECT_EQ(code("time,A.x,A.y,A.z\n0,1,2,3\n0,1,2,3\n"), "bad-times");
}

TEST(C3d, GoesRoundExactlyInFloat32) {
  Alone work;
  for (UpAxis up : {UpAxis::y, UpAxis::z}) {
    Points points = two_markers();
    points.up = up;
    const std::string bytes = write_c3d(points, {}, work);
    const Points back = read_c3d(bytes, unfilled(), work);
    expect_same(back, points, 1e-7);
    EXPECT_EQ(back.up, up);
    EXPECT_EQ(write_c3d(back, {}, work), bytes);
  }
}

TEST(C3d, HoldsMoreLabelsAndFramesThanOneParameterDoes) {
  Alone work;
  std::vector<std::string> labels;
  for (int i = 0; i < 300; ++i) labels.push_back("marker" + std::to_string(i));
  const Points many(labels, 120, 2);
  EXPECT_EQ(read_c3d(write_c3d(many, {}, work), {}, work).labels, labels);
  const Points longer({"A"}, 120, 70000);
  EXPECT_EQ(read_c3d(write_c3d(longer, {}, work), {}, work).frames, 70000u);
}

// Room is made for no more frames than the file has bytes for.
TEST(PointsFiles, WithManyColumnsAndManyShortLinesAreRefusedAtTheFirst) {
  Alone work;
  std::string header = "frame,time";
  for (int i = 0; i < 20000; ++i)
    for (const char* axis : {".x", ".y", ".z"}) header += ",p" + std::to_string(i) + axis;
  std::string lines;
  for (int i = 0; i < 300000; ++i) lines += "1\n";
  const Diagnostic told = refusal([&] { read_points_table(header + "\n" + lines, {}, work); });
  EXPECT_EQ(told.code, "too-few-values");
  EXPECT_EQ(told.place.line, 2);
}

TEST(PointsFiles, OfACommaDecimalProgramAreRefusedAsSuch) {
  Alone work;
  const Diagnostic table =
      refusal([&] { read_points_table("frame;time;a.x;a.y;a.z\n0;0;1;2,5;3\n", {}, work); });
  EXPECT_EQ(table.code, "decimal-comma");
  EXPECT_EQ(table.place.line, 2);
  EXPECT_EQ(table.place.column, 7);
  EXPECT_EQ(refusal([&] { read_trc(trc_text("1\t0,0\t1\t2\t3\t4\t5\t6\n", "1"), {}, work); }).code,
            "decimal-comma");
}

TEST(C3d, RefusesNumbersThatSinglePrecisionDoesNotHold) {
  Alone work;
  Points points({"far"}, 60, 2);
  points.track(0).set(1, {0, 1e39, 0});
  const Diagnostic told = refusal([&] { write_c3d(points, {}, work); });
  EXPECT_EQ(told.code, "too-large");
  EXPECT_EQ(told.frame, 1);
}

TEST(PointsFiles, TellLabelsThatTheyCannotHoldAsTheyAre) {
  Alone work;
  Points points({std::string(119, 'x') + "腰", "left\tarm"}, 60, 2);
  const Points back = read_c3d(write_c3d(points, {}, work), {}, work);
  EXPECT_EQ(back.labels[0], std::string(119, 'x'));  // no half of a character
  write_trc(points, "x", {}, work);
  EXPECT_EQ(codes(work), "label-cut label-changed");
}

TEST(C3d, IsRefusedWhereItIsDamaged) {
  Alone work;
  const std::string whole = write_c3d(two_markers(), {}, work);
  auto code = [&](const std::string& bytes) { return refusal([&] { read_c3d(bytes, {}, work); }).code; };
  EXPECT_EQ(code(""), "not-c3d");
  EXPECT_EQ(code(std::string(600, 'x')), "not-c3d");
  EXPECT_EQ(code(whole.substr(0, 513)), "truncated");
  EXPECT_EQ(code(whole.substr(0, 1024 + 32)), "truncated");
  for (std::size_t at = 0; at < whole.size(); at += 3) {  // any byte may be wrong
    std::string wrong = whole;
    wrong[at] = static_cast<char>(wrong[at] ^ 0x81);
    refusal([&] { read_c3d(wrong, {}, work); });
  }
}

TEST(C3d, GivesTheSameNumbersInAllThreeEncodings) {
  KINEGRAPH_NEEDS_MOCAP();
  const Points intel = load("points/Eb015pi.c3d", unfilled()), sgi = load("points/Eb015si.c3d", unfilled()),
               dec = load("points/Eb015vr.c3d", unfilled());
  ASSERT_EQ(intel.frames, 450u);
  ASSERT_EQ(intel.labels.size(), 26u);
  EXPECT_EQ(encoded(intel), encoded(sgi));
  expect_same(intel, dec, 6e-8);  // whole numbers times a scale against their float32
}

// Markers are on the skin, not where joints are; but each rides on a bone, about its mean place on which it
// strays as far as skin slides and the fit of the skeleton to these very markers left over: 10.7 mm in the
// mean of all 41, 27 mm at a knee. Were the trial read 3 frames late it would be 23 mm, 12 frames late 60 mm,
// 5 % too large or too small 51 mm.
TEST(C3d, LiesWhereTheSkeletonOfItsTrialDoes) {
  KINEGRAPH_NEEDS_MOCAP();
  const Points markers = load("points/cmu_02_01.c3d");
  PlainFiles files;
  Alone work;
  const MotionFile skeleton = read_motion_file(mocap("cmu/asfamc/02_01.amc"), {}, files, work);
  ASSERT_EQ(markers.frames, skeleton.motion()->frames());
  const WorldMotion world = world_motion(*skeleton.motion());
  struct Riding {
    double stray = 1e9, away = 0;  // root mean square about its mean place on a bone; distance from the joint
  };
  // The best over all bones, of the markers `scale` times as large and `late` frames after the skeleton.
  const auto riding = [&](int label, double scale, std::size_t late) {
    Riding best;
    for (int j = 0; j < world.joints(); ++j) {
      std::vector<Vec3> seen;
      Vec3 mean;
      for (std::size_t t = 0; t + late < markers.frames; t += 3) {
        if (markers.is_missing(label, t + late)) continue;
        seen.push_back(rotate(inverse(world.orientation(j)[t]),
                              scale * markers.track(label)[t + late] - world.position(j)[t]));
        mean += seen.back();
      }
      mean = mean / static_cast<double>(seen.size());
      double sum = 0;
      for (const Vec3& one : seen) sum += dot(one - mean, one - mean);
      const double stray = std::sqrt(sum / static_cast<double>(seen.size()));
      if (stray < best.stray) best = {stray, norm(mean)};
    }
    return best;
  };
  const auto mean_stray = [&](double scale, std::size_t late) {
    double sum = 0;
    for (int label = 0; label < int(markers.labels.size()); ++label) sum += riding(label, scale, late).stray;
    return sum / static_cast<double>(markers.labels.size());
  };
  const double stray = mean_stray(1, 0);
  EXPECT_LT(stray, 0.012);
  for (const double scale : {0.95, 1.05}) EXPECT_GT(mean_stray(scale, 0), 4 * stray);
  EXPECT_GT(mean_stray(1, 3), 2 * stray);
  for (int label = 0; label < int(markers.labels.size()); ++label) {
    const Riding own = riding(label, 1, 0);
    EXPECT_LT(own.stray, 0.03) << markers.labels[label];
    EXPECT_LT(own.away, 0.45) << markers.labels[label];  // an ankle's marker rides on the shin
  }
}

// The trial as a lab would give it away, Z up: its skeleton as a BVH and its joints as markers.
TEST(PointsFiles, WhoseZPointsUpLieWhereTheSkeletonOfTheSameLabDoes) {
  KINEGRAPH_NEEDS_MOCAP();
  PlainFiles files;
  Alone work;
  const MotionFile trial = read_motion_file(mocap("cmu/asfamc/02_01.amc"), {}, files, work);
  Motion motion = *trial.motion();
  auto facts = std::make_shared<SourceFacts>();
  facts->up = UpAxis::z;
  motion.set_source(facts);
  const ValuePtr value = points_of_motion(motion);
  Points joints = dynamic_cast<const Points&>(*value);
  joints.up = UpAxis::z;
  files.made["/lab.bvh"] = write_bvh(motion, {.precision = 9}, work);
  files.made["/lab.c3d"] = write_c3d(joints, {}, work);
  files.made["/lab.trc"] = write_trc(joints, "lab.trc", {}, work);
  ReadOptions z_up = unfilled();
  z_up.up = "z";
  z_up.unit = Json("m");
  const MotionFile skeleton = read_motion_file("/lab.bvh", z_up, files, work);
  const WorldMotion world = world_motion(*skeleton.motion());
  for (const char* name : {"/lab.c3d", "/lab.trc"}) {
    const MotionFile file = read_motion_file(name, z_up, files, work);
    const Points& markers = *file.points();
    ASSERT_EQ(markers.labels.size(), joints.labels.size());
    auto joint_of = [&](int label) { return skeleton.motion()->skeleton().find(markers.labels[label]); };
    double farthest = 0;
    for (int label = 0; label < int(markers.labels.size()); ++label)
      for (std::size_t t = 0; t < markers.frames; ++t)
        farthest = std::max(farthest, norm(markers.track(label)[t] - world.position(joint_of(label))[t]));
    EXPECT_LT(farthest, 2e-6) << name;
  }
}

TEST(C3d, AndTrcOfOneTrialAreEqualWithinTheTextsDigits) {
  KINEGRAPH_NEEDS_MOCAP();
  ReadOptions z_up = unfilled();
  z_up.up = "z";  // the C3D says so, a TRC can't
  const Points binary = load("points/walking2.c3d", unfilled()),
               text = load("points/std_walking2_markers.trc", z_up);
  EXPECT_EQ(binary.fps, 250);
  EXPECT_EQ(text.fps, 25);  // its times, not its DataRate
  ASSERT_EQ(binary.labels, text.labels);
  std::size_t compared = 0;
  double farthest = 0;
  for (int label = 0; label < int(text.labels.size()); ++label)
    for (std::size_t t = 0; t + 1 < text.frames; ++t) {  // its last row stands off the beat
      ASSERT_EQ(text.is_missing(label, t), binary.is_missing(label, 10 * t))
          << text.labels[label] << " " << t;
      if (text.is_missing(label, t)) continue;
      ++compared;
      const Vec3 written = text.track(label)[t], real = binary.track(label)[10 * t];
      for (int axis = 0; axis < 3; ++axis)
        farthest = std::max(farthest, std::fabs(written[axis] - real[axis]) / std::fabs(real[axis]));
    }
  EXPECT_GT(compared, 2000u);
  EXPECT_LT(farthest, 5.1e-5);  // the text has five digits
}

TEST(PointsFiles, OfTheFaceAreTheSameAsTableAndAsTrc) {
  KINEGRAPH_NEEDS_MOCAP();
  ReadOptions options;
  options.unit = "cm";
  expect_same(load("points/face_eyebrows.csv", options), load("points/face_eyebrows.trc"), 1e-12);
}

TEST(PointsFiles, AreCutAndResampledAsTheOptionsSay) {
  KINEGRAPH_NEEDS_MOCAP();
  ReadOptions options;
  options.range = {10, 110};
  const Points cut = load("points/face_jaw.trc", options), whole = load("points/face_jaw.trc");
  ASSERT_EQ(cut.frames, 100u);
  EXPECT_EQ(cut.track(3)[0], whole.track(3)[10]);
  options.fps = 30;
  const Points slower = load("points/face_jaw.trc", options);
  ASSERT_EQ(slower.frames, 50u);
  EXPECT_EQ(slower.track(3)[7], cut.track(3)[14]);
}

}  // namespace
}  // namespace kinegraph
