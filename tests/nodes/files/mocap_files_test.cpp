// Every file of the shared motion capture: those that must load, with joints or markers, frames and rate as
// its README states them (an .amc has a joint for each of its .asf's 30 bones and the root; a TRC whose times
// differ from its DataRate goes by its times), and those that must be refused. A file in neither list fails.
#include <gtest/gtest.h>

#include <set>

#include "nodes/files/bvh_write.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/skeleton.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

struct Loads {
  const char* file;
  int joints;  // or markers
  std::size_t frames;
  double fps;
  const char* unit;
  const char* warnings = "";  // codes, in order
};

void PrintTo(const Loads& one, std::ostream* out) {
  *out << one.file;
}

const std::vector<Loads>& files_that_load() {
  static const std::vector<Loads> files = {
#include "tests/nodes/files/mocap_files.inc"
  };
  return files;
}

MotionFile load(const std::string& path, Alone& work) {
  PlainFiles files;
  return read_motion_file(path, {}, files, work);
}

class MocapFile : public testing::TestWithParam<Loads> {};

TEST_P(MocapFile, LoadsAsItsReadmeSays) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const MotionFile file = load(mocap(GetParam().file), work);
  if (const Motion* motion = file.motion()) {
    EXPECT_EQ(motion->joints(), GetParam().joints);
    EXPECT_EQ(motion->frames(), GetParam().frames);
    EXPECT_NEAR(motion->fps(), GetParam().fps, 1e-9);
    EXPECT_EQ(motion->source().unit_name, GetParam().unit);
  } else {
    const Points* points = file.points();
    ASSERT_NE(points, nullptr);
    EXPECT_EQ(int(points->labels.size()), GetParam().joints);
    EXPECT_EQ(points->frames, GetParam().frames);
    EXPECT_NEAR(points->fps, GetParam().fps, 1e-9);
    EXPECT_EQ(points->unit_name, GetParam().unit);
  }
  for (const FileContent& content : file.contents) EXPECT_FALSE(content.value->non_finite()) << content.port;
  std::string codes;
  for (const Diagnostic& one : work.reported)
    if (one.severity == Severity::warning) codes += (codes.empty() ? "" : " ") + one.code;
  EXPECT_EQ(codes, GetParam().warnings);
}

std::string test_name(const std::string& file) {
  std::string name = file;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(All, MocapFile, testing::ValuesIn(files_that_load()),
                         [](const auto& one) { return test_name(one.param.file); });

// Whatever unit a file is in, and whether it says so or it had to be found: people come out as tall as
// people.
TEST(MocapFiles, HoldPeopleOfAPersonsSize) {
  KINEGRAPH_NEEDS_MOCAP();
  // Animals, props, a chain, legs that are cut off at the knee (a depth camera's), a rig in decimetres, which
  // no unit here is, and a game's dwarf.
  const std::set<std::string> other = {"gltf/Fox.glb",
                                       "gltf/RiggedSimple.glb",
                                       "gltf/SimpleSkin.gltf",
                                       "gltf/KayKit_Knight.glb",
                                       "odd/makehuman_tpose.bvh",
                                       "gltf/rig_transfer_from_bvh.glb",
                                       "odd/rotation_first_root.bvh",
                                       "odd/sinusoidal_no_endsite.bvh"};
  int people = 0;
  for (const Loads& one : files_that_load()) {
    Alone work;
    const MotionFile file = load(mocap(one.file), work);
    if (!file.motion() || other.count(one.file)) continue;
    const double legs = leg_length(file.motion()->skeleton());
    EXPECT_GT(legs, 0.5) << one.file;
    EXPECT_LT(legs, 1.1) << one.file;
    ++people;
  }
  EXPECT_GE(people, 70);
}

auto bvh_files() {
  auto files = files_that_load();
  std::erase_if(files, [](const auto& one) { return !std::string(one.file).ends_with(".bvh"); });
  return files;
}
class MocapBvh : public MocapFile {};
INSTANTIATE_TEST_SUITE_P(All, MocapBvh, testing::ValuesIn(bvh_files()),
                         [](const auto& one) { return test_name(one.param.file); });

struct Refused {
  const char* file;
  const char* code;
  int line, column;
};
const Refused refused[] = {
    {"odd/derived/too_few_values.bvh", "too-few-values", 191, 384},
    {"odd/derived/comma_decimal.bvh", "decimal-comma", 187, 13},
    {"odd/Truncated.trc", "truncated", 3, 1},
    {"cmu/cmu-index.csv", "bad-header", 1, 1},
    {"README.md", "unknown-format", 0, 0},
};

TEST(MocapFiles, ThatAreDamagedAreRefusedWithLineColumnAndReason) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const Refused& one : refused) {
    Alone work;
    try {
      load(mocap(one.file), work);
      ADD_FAILURE() << one.file << " loaded";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, one.code) << one.file;
      EXPECT_EQ(failure.diagnostic().place.line, one.line) << one.file;
      EXPECT_EQ(failure.diagnostic().place.column, one.column) << one.file;
      EXPECT_EQ(failure.diagnostic().file, mocap(one.file));
    }
  }
}

TEST(MocapFiles, AreAllInOneOfTheTwoLists) {
  KINEGRAPH_NEEDS_MOCAP();
  std::set<std::string> listed;
  for (const Loads& one : files_that_load()) listed.insert(one.file);
  for (const Refused& one : refused) listed.insert(one.file);
  const auto root = std::filesystem::path(mocap());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    EXPECT_TRUE(listed.count(entry.path().lexically_relative(root).string())) << entry.path();
  }
}

// BVH of cgspeed's conversion against the original: frame k + 1 against frame k, in the file's unit. What the
// README there says agrees: root, legs, and elbows and hands relative to the base of the shoulder.
TEST(MocapFiles, OfOneTrialAgreeInAmcAndBvh) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* trial : {"02_01", "02_04", "05_03", "07_05", "09_06"}) {
    Alone work;
    PlainFiles files;
    ReadOptions bvh_options;
    bvh_options.drop_rest_frame = true;
    bvh_options.unit = Json("cmu");
    const MotionFile bvh_file =
        read_motion_file(mocap(std::string("cmu/bvh/") + trial + ".bvh"), bvh_options, files, work);
    const MotionFile amc_file =
        read_motion_file(mocap(std::string("cmu/asfamc/") + trial + ".amc"), {}, files, work);
    const Motion &bvh = *bvh_file.motion(), &amc = *amc_file.motion();
    ASSERT_EQ(bvh.frames(), amc.frames()) << trial;
    const WorldMotion in_bvh = world_motion(bvh), in_amc = world_motion(amc);
    auto bvh_joint = [&](const char* name) { return in_bvh.position(bvh.skeleton().find(name)); };
    auto amc_joint = [&](const char* name) { return in_amc.position(amc.skeleton().find(name)); };
    const double unit = amc.source().unit;
    double worst = 0;
    for (std::size_t t = 0; t < amc.frames(); ++t) {
      // A BVH joint lies at the start of the bone that the .asf calls by the second name.
      for (auto [joint, bone] : {std::pair{"Hips", "root"},
                                 {"LeftUpLeg", "lfemur"},
                                 {"LeftLeg", "ltibia"},
                                 {"LeftFoot", "lfoot"},
                                 {"LeftToeBase", "ltoes"},
                                 {"RightLeg", "rtibia"},
                                 {"RightFoot", "rfoot"},
                                 {"RightToeBase", "rtoes"}})
        worst = std::max(worst, norm(bvh_joint(joint)[t] - amc_joint(bone)[t]) / unit);
      for (auto [joint, bone] : {std::pair{"LeftForeArm", "lradius"}, {"LeftHand", "lwrist"}})
        worst = std::max(worst, norm((bvh_joint(joint)[t] - bvh_joint("LeftShoulder")[t]) -
                                     (amc_joint(bone)[t] - amc_joint("lclavicle")[t])) /
                                    unit);
    }
    EXPECT_LT(worst, 2e-4) << trial;
  }
}

// An .amc becomes a BVH that holds the same motion: every joint of every frame within 1e-5 m.
TEST(MocapFiles, InAmcMoveTheSameAsBvh) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const Loads& one : files_that_load()) {
    if (!std::string(one.file).ends_with(".amc")) continue;
    Alone work;
    const MotionFile amc = load(mocap(one.file), work);
    PlainFiles files;
    files.made["/it.bvh"] = write_bvh(*amc.motion(), {}, work);
    ReadOptions same_unit;
    same_unit.unit = Json(amc.motion()->source().unit);
    const MotionFile bvh = read_motion_file("/it.bvh", same_unit, files, work);
    const Motion &was = *amc.motion(), &is = *bvh.motion();
    ASSERT_EQ(was.frames(), is.frames()) << one.file;
    ASSERT_EQ(was.joints(), is.joints()) << one.file;
    const WorldMotion before = world_motion(was), after = world_motion(is);
    double farthest = 0;
    for (int j = 0; j < was.joints(); ++j) {
      const int k = is.skeleton().find(was.skeleton().joints[j].name);
      ASSERT_GE(k, 0) << was.skeleton().joints[j].name;
      for (std::size_t t = 0; t < was.frames(); ++t)
        farthest = std::max(farthest, norm(before.position(j)[t] - after.position(k)[t]));
    }
    EXPECT_LT(farthest, 1e-5) << one.file;
    EXPECT_NEAR(was.fps(), is.fps(), 1e-9) << one.file;
  }
}

// Every BVH goes back out with its channels, OFFSETs, End Sites, names, order and frame time; angles within
// 1e-5 degrees as they were read, positions within 1e-6 of the unit.
TEST_P(MocapBvh, GoesBackOutAsItWasRead) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const MotionFile file = load(mocap(GetParam().file), work);
  PlainFiles files;
  files.made["/back.bvh"] = write_bvh(*file.motion(), {}, work);
  ReadOptions same_unit;
  same_unit.unit = Json(file.motion()->source().unit);
  const MotionFile back_file = read_motion_file("/back.bvh", same_unit, files, work);
  const SourceFacts &was = file.motion()->source(), &is = back_file.motion()->source();
  EXPECT_EQ(was.frame_time_text, is.frame_time_text);
  ASSERT_EQ(was.bvh.size(), is.bvh.size());
  std::vector<bool> is_angle;
  for (std::size_t j = 0; j < was.bvh.size(); ++j) {
    EXPECT_EQ(file.motion()->skeleton().joints[j].name, back_file.motion()->skeleton().joints[j].name);
    EXPECT_EQ(file.motion()->skeleton().joints[j].parent, back_file.motion()->skeleton().joints[j].parent);
    EXPECT_EQ(was.bvh[j].channels, is.bvh[j].channels);
    EXPECT_EQ(was.bvh[j].offset, is.bvh[j].offset);
    for (const std::string& channel : was.bvh[j].channels) is_angle.push_back(channel[1] == 'r');
  }
  EXPECT_EQ(was.bvh_ends, is.bvh_ends);
  ASSERT_EQ(was.read->size(), is.read->size());
  double angles = 0, positions = 0;
  for (std::size_t i = 0; i < was.read->size(); ++i) {
    const double apart = std::fabs((*was.read)[i] - (*is.read)[i]);
    double& worst = is_angle[i / was.read_frames] ? angles : positions;
    worst = std::max(worst, apart);
  }
  EXPECT_LE(angles, 1e-5);
  EXPECT_LE(positions, 1e-6);
}

}  // namespace
}  // namespace kinegraph
