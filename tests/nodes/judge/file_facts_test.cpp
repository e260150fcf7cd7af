// What a person is told of a file before using it, on files of every kind.
#include "nodes/judge/file_facts.h"

#include <gmock/gmock.h>

#include <map>

#include "nodes/components/components.h"
#include "nodes/motion/character.h"
#include "nodes/motion/metrics.h"
#include "tests/mocap.h"
#include "tests/nodes/files/bvh_texts.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

struct Told {
  FileFacts facts;
  std::string text;
  Json json;
};
Told told_of(PlainFiles& files, const std::string& path) {
  Alone work;
  ReadOptions options;
  options.max_gap = 0;
  const MotionFile file = read_motion_file(path, options, files, work);
  Told told;
  told.facts = facts_of(file, path, files, work.reported, work);
  told.text = facts_text(file, told.facts, "it");
  told.json = facts_json(file, told.facts, "it");
  return told;
}
Told told_of(const std::string& path) {
  PlainFiles files;
  return told_of(files, mocap(path));
}
std::string codes(const FileFacts& facts) {
  std::string all;
  for (const Diagnostic& one : facts.told) all += one.code + ' ';
  return all;
}

TEST(FileFacts, OfAWalkAreWhatAPersonAsks) {
  KINEGRAPH_NEEDS_MOCAP();
  const Told walk = told_of("cmu/bvh/08_01.bvh");
  EXPECT_TRUE(walk.facts.motion->rest_frame);
  ASSERT_TRUE(walk.facts.motion->contacts);
  EXPECT_GE(runs_of(walk.facts.motion->contacts->points[0].planted).size(), 2u);
  for (const char* line :
       {"it: bvh, motion", "frames    278 at 120 a second, 2.32 s", "unit      cmu (0.0564444 m), found by",
        "up        Y", "height    1.38 m in the rest pose", "legs 0.799 m",
        "skeleton  31 joints, 7 End Sites", "channels  3 Zrotation Yrotation Xrotation: 30 joints",
        "feet      LeftFoot heel", "flip of RThumb", "\n    LeftUpLeg  "})
    EXPECT_THAT(walk.text, HasSubstr(line));
  for (const char* key :
       {"frames", "fps", "seconds", "unit", "unit_name", "unit_from", "up", "rest_height", "leg_length",
        "rest_frame", "contacts", "joints", "ends", "breaks", "finite", "diagnostics"})
    EXPECT_TRUE(walk.json.find(key)) << key;
}

TEST(FileFacts, OfMarkersCountWhatIsMissingInTheFile) {
  KINEGRAPH_NEEDS_MOCAP();
  const Told trial = told_of("points/Eb015pi.c3d");
  EXPECT_EQ(trial.facts.up, "Z");
  EXPECT_EQ(trial.facts.points->missing, 226u);
  EXPECT_EQ(trial.facts.points->longest, 47u);
  EXPECT_THAT(trial.text, HasSubstr("unit      mm (0.001 m), as POINT:UNITS says"));
  EXPECT_THAT(trial.text, HasSubstr("longest: PV2, frames 403 to 449"));
  EXPECT_EQ(codes(trial.facts).find("long-gap"), std::string::npos);
  EXPECT_NEAR(trial.facts.points->height, 0.93, 0.01);
}

// Bandai-Namco's root stays at the origin while the hips walk off.
TEST(FileFacts, TellHowFarTheHipsGoWhereTheRootStays) {
  KINEGRAPH_NEEDS_MOCAP();
  EXPECT_GT(told_of("bandai/dataset-1_walk_normal_001.bvh").facts.motion->travel, 1);
}

TEST(FileFacts, OfMarkersTellWhetherTheFigureLiesDown) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* lying : {"points/std_walking2_markers.trc", "points/dataWithBlanksForMissingMarkers.trc",
                            "odd/Dance_badstart.c3d"})
    EXPECT_THAT(codes(told_of(lying).facts), HasSubstr("up-axis")) << lying;
  for (const char* standing : {"points/walking2.c3d", "points/cmu_02_01.c3d", "points/Eb015pi.c3d",
                               "points/face_jaw.trc", "points/gait10dof18musc_walk_CRLF_line_ending.trc"})
    EXPECT_THAT(codes(told_of(standing).facts), testing::Not(HasSubstr("up-axis"))) << standing;
}

TEST(FileFacts, OfC3dTellThatAnalogDataIsNotRead) {
  KINEGRAPH_NEEDS_MOCAP();
  EXPECT_THAT(codes(told_of("points/walking2.c3d").facts), HasSubstr("analog-left-out"));
  EXPECT_THAT(codes(told_of("points/cmu_02_01.c3d").facts), testing::Not(HasSubstr("analog-left-out")));
}

TEST(FileFacts, OfMorphTargetsTellWeightsThatBlenderDoesNotReach) {
  auto face = std::make_shared<Character>();
  face->parts.emplace_back().morphs = {{"brow", {}, {}}, {"jaw", {}, {}}};
  face->morph_fps = 30;
  face->morph_tracks = {{0, 0, {0, 1, 0.5}}, {0, 1, {0, 0.25, -0.125}}};
  MotionFile file;
  file.contents.push_back({"character", face});
  PlainFiles files;
  Alone work;
  const FileFacts facts = facts_of(file, "face", files, {}, work);
  EXPECT_EQ(codes(facts), "morph-weights ");
  EXPECT_THAT(facts.told.at(0).message,
              HasSubstr("from -0.125 to 1, and Blender holds them between 0 and 1: jaw"));
}

TEST(FileFacts, OfGltfListClipsSkinsAndMeshesAndWhatRepairMends) {
  KINEGRAPH_NEEDS_MOCAP();
  const Told knight = told_of("gltf/KayKit_Knight.glb");
  EXPECT_EQ(knight.facts.gltf->clips.size(), 76u);
  EXPECT_EQ(knight.facts.gltf->clips[0].name, "1H_Melee_Attack_Chop");
  EXPECT_EQ(knight.facts.gltf->clips[0].keys, 33u);
  EXPECT_EQ(knight.facts.gltf->skins.at(0).joints, 41u);
  EXPECT_EQ(knight.facts.gltf->meshes.size(), 15u);
  const Told man = told_of("gltf/CesiumMan.glb");
  EXPECT_THAT(codes(man.facts), HasSubstr("uneven-weights"));
  EXPECT_THAT(codes(man.facts), HasSubstr("skinned-below"));
  EXPECT_THAT(man.text, HasSubstr("clips     1: "));
}

TEST(FileFacts, NameWhatOtherProgramsStumbleOver) {
  PlainFiles files;
  files.made["/odd.bvh"] =
      "HIERARCHY\nROOT Hips it\n{\n OFFSET 0 5 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation "
      "Xrotation "
      "Yrotation\n JOINT Arm\n {\n  OFFSET 0 60 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n }\n}\n"
      "MOTION\nFrames: 2\nFrame Time: 0.01\n0 5 0 0 0 179 0 0 0\n0 5 0 0 0 -179 0 0 0\n";
  const std::string all = codes(told_of(files, "/odd.bvh").facts);
  for (const char* code : {"three-adds-offset", "assimp-names", "three-names", "euler-wraps", "no-end-site"})
    EXPECT_THAT(all, HasSubstr(code));
}

// What a person asks, on files that answer it each in its own way: as text, and the value under a key as
// JSON.
TEST(FileFacts, AnswerEachQuestionOnRealFiles) {
  KINEGRAPH_NEEDS_MOCAP();
  struct Answer {
    const char *question, *file, *text, *key, *json;
  };
  const Answer answers[] = {
      {"kind", "cmu/asfamc/17_10.amc", "it: asf-amc, motion\n", "format", "\"asf-amc\""},
      {"kind", "gltf/Fox.glb", "it: gltf, motion and character\n", "contents", "[\"motion\",\"character\"]"},
      {"kind", "points/walking2.c3d", "it: c3d, points\n", "contents", "[\"points\"]"},
      {"frames", "odd/MS2_8Walk_M.bvh", "frames    1588 at 30 a second, 52.9 s", "frames", "1588"},
      {"rate", "points/walking2.c3d", "1249 at 250 a second", "fps", "250"},
      {"length", "cmu/asfamc/17_10.amc", "2783 at 120 a second, 23.2 s", "seconds", "23.19"},
      {"unit, by height", "cmu/bvh/08_01.bvh",
       "unit      cmu (0.0564444 m), found by the figure's height, as the file doesn't say", "unit_name",
       "\"cmu\""},
      {"unit, said", "cmu/asfamc/17_10.amc", "unit      cmu (0.0564444 m), as :units says", "unit_from",
       "\"as :units says\""},
      {"unit of markers", "points/face_eyebrows.trc", "unit      cm (0.01 m), as Units says", "unit", "0.01"},
      {"unit of glTF", "gltf/Fox.glb", "as glTF has it", "unit", "1"},
      {"height", "cmu/bvh/08_01.bvh", "height    1.38 m in the rest pose, 1.39 m in frame 1", "rest_height",
       "1.37"},
      {"height of markers", "points/walking2.c3d", "height    1.68 m at most", "height", "1.6"},
      {"up axis", "points/walking2.c3d", "up        Z", "up", "\"Z\""},
      {"up axis", "gltf/Fox.glb", "up        Y", "up", "\"Y\""},
      {"skeleton", "gltf/Fox.glb", "skeleton  24 joints, 0 End Sites", "ends", "[]"},
      {"skeleton as a tree", "gltf/Fox.glb",
       "\n      b_Tail01_012  4.260 15.959 0.000\n        b_Tail02_013  ", "joints",
       "[{\"name\":\"_rootJoint\",\"offset\":["},
      {"channel layout", "odd/rotation_first_root.bvh",
       "channels  6 Zrotation Xrotation Yrotation Xposition Yposition Zposition: ", "joints",
       "\"channels\":[\"Zrotation\",\"Xrotation\",\"Yrotation\",\"Xposition\""},
      {"channel layout of several kinds", "odd/mixed_orders_test3.bvh",
       "channels  3 Yrotation Zrotation Xrotation: RightForeArm, LeftForeArm", "", ""},
      {"channel layout of AMC", "cmu/asfamc/17_10.amc", "channels  6 tx ty tz rx ry rz: root\n", "joints",
       "\"channels\":[\"tx\",\"ty\",\"tz\",\"rx\",\"ry\",\"rz\"],\"name\":\"root\""},
      {"channel layout of single bones", "cmu/asfamc/17_10.amc", "channels  2 ry rz: lclavicle, rclavicle\n",
       "", ""},
      {"bones that don't move", "cmu/asfamc/17.asf", "channels  0: lhipjoint, rhipjoint\n", "", ""},
      {"unit where the rest pose is none", "bandai/dataset-1_walk_old_001.bvh",
       "the first frame is 136.7 units high, 1.37 m so", "unit_name", "\"cm\""},
      {"no person's size", "gltf/rig_transfer_from_bvh.glb",
       "info: odd-size: unit: the figure is 23.6 m high, which is no person's size; taken as cmu",
       "diagnostics", "\"code\":\"odd-size\""},
      {"T-pose in front", "cmu/bvh_daz/49_06.bvh", "warning: rest-frame: ", "rest_frame", "true"},
      {"no T-pose in front", "xia/old_13_000.bvh", "m in frame 0", "rest_frame", "false"},
      {"missing markers", "points/walking2.c3d", "missing   27567 of 54956 samples", "missing", "27567"},
      {"longest gap", "points/walking2.c3d", "longest: LCAL, frames 0 to 422", "longest_gap",
       "{\"frame\":0,\"frames\":423,\"label\":\"LCAL\"}"},
      {"missing of each marker", "points/walking2.c3d", "RLFC 67 %", "missing_of", "\"RLFC\":"},
      {"nothing missing", "points/face_jaw.trc", "missing   none", "missing", "0"},
      {"flips", "cmu/bvh/08_01.bvh", "flip of RThumb at frame 199: 171°", "breaks",
       "\"frame\":199,\"joint\":\"RThumb\",\"kind\":\"flip\""},
      {"jumps", "cmu/asfamc/17_10.amc", "jump of ltoes at frame 1146: 27°", "breaks",
       "\"frame\":1146,\"joint\":\"ltoes\",\"kind\":\"jump\""},
      {"spikes", "odd/MS2_8Walk_M.bvh", "spike of RightHand at frame 490", "breaks",
       "\"frame\":490,\"joint\":\"RightHand\",\"kind\":\"spike\""},
      {"jumps of markers", "points/walking2.c3d", "jump of LMFC at frame 616: 0.0459 m", "breaks",
       "\"frame\":616,\"kind\":\"jump\",\"label\":\"LMFC\""},
      {"no breaks", "gltf/Fox.glb", "breaks    no flips, jumps or spikes", "breaks", "[]"},
      {"numbers", "gltf/Fox.glb", "numbers   all finite", "finite", "true"},
      {"foot contacts", "cmu/asfamc/17_10.amc", "feet      lfoot heel 10 plants, 8 %; lfoot ball 37 plants",
       "contacts", "\"foot\":\"lfoot\",\"part\":\"heel\",\"plants\":[["},
      {"no feet", "odd/sinusoidal_no_endsite.bvh", "feet      none found", "contacts", "null"},
      {"three.js", "bandai/dataset-1_walk_old_001.bvh",
       "warning: three-adds-offset: three.js adds OFFSET and position", "diagnostics",
       "\"code\":\"three-adds-offset\""},
      {"three.js and names", "odd/derived/namespaced_joints.bvh", "warning: three-names: ", "diagnostics",
       "\"code\":\"three-names\""},
      {"filters and wraps", "odd/MS2_8Walk_M.bvh", "info: euler-wraps: frame 294: ", "diagnostics",
       "\"code\":\"euler-wraps\""},
      {"no End Site", "odd/sinusoidal_no_endsite.bvh", "info: no-end-site: ", "diagnostics",
       "\"code\":\"no-end-site\""},
      {"validator", "gltf/CesiumMan.glb", "uneven-weights", "gltf", "\"uneven_vertices\":"}};
  std::map<std::string, Told> read;
  for (const Answer& answer : answers) {
    SCOPED_TRACE(std::string(answer.question) + " of " + answer.file);
    if (!read.count(answer.file)) read[answer.file] = told_of(answer.file);
    const Told& told = read[answer.file];
    EXPECT_THAT(told.text, HasSubstr(answer.text));
    const Json* value = *answer.key ? told.json.find(answer.key) : nullptr;
    EXPECT_EQ(value != nullptr, *answer.key != 0) << answer.key;
    if (value) {
      std::string json = compact(*value);
      for (const char* space : {": ", ", "})
        for (std::size_t at = 0; (at = json.find(space, at)) != json.npos; ++at) json.erase(at + 1, 1);
      EXPECT_THAT(json, HasSubstr(answer.json));
    }
  }
}

TEST(FileFacts, OfAFileWithANumberThatIsNoneSayWhere) {
  PlainFiles files;
  std::string text = small_bvh(two_frames());
  files.made["/nan.bvh"] = text.replace(text.rfind(' '), 1, " nan ");
  try {
    told_of(files, "/nan.bvh");
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "not-finite");
    EXPECT_GT(failure.diagnostic().place.line, 0);
  }
}

TEST(FileFacts, SayWhereTheFigureLiesAlongZ) {
  KINEGRAPH_NEEDS_MOCAP();
  EXPECT_THAT(codes(told_of("fair/dab.bvh").facts), HasSubstr("up-axis"));
  EXPECT_EQ(codes(told_of("fair/dab.bvh").facts).find("odd-size"), std::string::npos);
  EXPECT_EQ(codes(told_of("cmu/bvh_daz/49_06.bvh").facts).find("up-axis"), std::string::npos);
}

TEST(FileFacts, OfComponentsTellWhatEachMoves) {
  Components c;
  c.space.of_motions = false;
  c.space.labels = {"brow", "jaw"};
  c.fps = 50;
  c.mean.assign(6, 0);
  c.mixing = Rows(6, 2);
  c.mixing(1, 0) = 2;
  c.mixing(4, 1) = 1;
  c.signals = Rows(2, 100);
  c.unmixing = Rows(2, 6);
  for (std::size_t t = 0; t < 100; ++t) c.signals(0, t) = t % 2 ? 1 : -1;
  c.shares = {0.7, 0.2};
  c.unique = {true, false};
  const auto clip = std::make_shared<const Points>(c.space.labels, 50, 100);
  c.segments.push_back({0, 100, nullptr, clip, {}});
  MotionFile file;
  file.format = "json";
  file.contents.push_back({"components", std::make_shared<const Components>(c)});
  FileFacts facts;
  facts.format = "json";
  facts.ports = "components";
  const std::string text = facts_text(file, facts, "it");
  for (const char* line :
       {"components 2 independent of points, 90.0 % of the variance", "u1        70.0 % of the variance",
        "moves brow", "not unique", "segment 0 100 frames at 50 a second, 2 s", "points    2: brow, jaw"})
    EXPECT_THAT(text, HasSubstr(line));
  const Json json = facts_json(file, facts, "it");
  EXPECT_EQ(json.find("components")->number(), 2);
  EXPECT_EQ(json.find("shares")->array()[1].number(), 0.2);
}

TEST(FileFacts, OfMetricsListTheNumbers) {
  Metrics metrics;
  metrics.all = {{"skate", 0.25, "cm/s"}, {"plants", {}, ""}};
  MotionFile file;
  file.contents.push_back({"metrics", std::make_shared<const Metrics>(metrics)});
  const std::string text = facts_text(file, {}, "it");
  EXPECT_THAT(text, HasSubstr("skate 0.25 cm/s"));
  EXPECT_THAT(text, HasSubstr("plants unknown"));
}

}  // namespace
}  // namespace kinegraph
