// The cartoon graphs of tests/cartoon on real clips, run by the real program and judged on what they export.
#include <cmath>
#include <map>

#include "nodes/feet/detect_contacts.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/kinematics.h"
#include "tests/headless/program.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

constexpr const char* every_graph[] = {"walk",  "run",        "kick",   "dance",    "boxing",
                                       "fig14", "cesium_man", "knight", "cmu_body", "chain"};

class CartoonGraphs : public ProgramTest {
 protected:
  Ran run_graph(const std::string& name) {
    return run({"run", source_folder() + "/tests/cartoon/" + name + ".kg.json", "--var", "mocap=" + mocap(),
                "--out", path("out"), "--progress", "none"});
  }
  MotionFile exported(const std::string& file) {
    PlainFiles files;
    Alone work;
    return read_motion_file(path("out/" + file), {}, files, work);
  }
};

TEST_F(CartoonGraphs, RunAndExportSubJointsThatStretch) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const std::string name : every_graph) {
    const Ran ran = run_graph(name);
    ASSERT_EQ(ran.exit, 0) << name << "\n" << ran.err;
    const bool skinned = exists("out/" + name + ".glb");
    const MotionFile file = exported(name + (skinned ? ".glb" : ".bvh"));
    ASSERT_TRUE(file.motion()) << name;
    const Motion& motion = *file.motion();
    EXPECT_GT(motion.joints(), 50) << name;
    int stretching = 0;
    for (int j = 1; j < motion.joints(); ++j) stretching += motion.translates(j);
    EXPECT_GT(stretching, 30) << name;
    EXPECT_EQ(file.find("character") != nullptr, skinned) << name;
  }
}

TEST_F(CartoonGraphs, BoxingHitsItsTargetWhileFeetStandWhereTheyStood) {
  KINEGRAPH_NEEDS_MOCAP();
  ASSERT_EQ(run_graph("boxing").exit, 0);
  const MotionFile file = exported("boxing.bvh");
  const Motion& motion = *file.motion();
  const WorldMotion world = world_motion(motion);
  const int fist = motion.skeleton().find("RightHand");
  for (std::size_t t = 117; t < 127; ++t)
    EXPECT_LT(norm(world.position(fist)[t] - Vec3{0.46, 1.51, 0.68}), 1e-3) << t;
  // What stands in the clip stands still, both feet while the fist is held.
  ReadOptions options;
  options.range = {221, 461};
  PlainFiles files;
  Alone work;
  const MotionFile source = read_motion_file(mocap("cmu/bvh/02_05.bvh"), options, files, work);
  int planted = 0, meanwhile = 0;
  for (const FootPoint& point : detect_contacts(*source.motion(), {}, work).points) {
    const int joint = motion.skeleton().find(point.joint_name);
    for (std::size_t t = 1; t < motion.frames(); ++t) {
      if (!point.planted[t - 1] || !point.planted[t]) continue;
      ++planted;
      meanwhile += t >= 117 && t < 127;
      ASSERT_LT(norm(point_at(world, joint, point.local, t) - point_at(world, joint, point.local, t - 1)),
                1e-3)
          << point.joint_name << " " << t;
    }
  }
  EXPECT_GT(planted, 400);
  EXPECT_GE(meanwhile, 20);
}

// Largest change of a link's length over its mean.
double stretch_of(const Motion& motion) {
  const WorldMotion world = world_motion(motion);
  double most = 0;
  for (int j = 1; j < motion.joints(); ++j) {
    const auto a = world.position(j), b = world.position(motion.skeleton().joints[j].parent);
    double mean = 0;
    for (std::size_t t = 0; t < motion.frames(); ++t)
      mean += norm(a[t] - b[t]) / static_cast<double>(motion.frames());
    if (mean < 0.02) continue;
    for (std::size_t t = 0; t < motion.frames(); ++t)
      most = std::max(most, std::fabs(norm(a[t] - b[t]) / mean - 1));
  }
  return most;
}

// How far hands and feet go from their mean place beside the hips, metres.
double swing_of(const Motion& motion) {
  const WorldMotion world = world_motion(motion);
  double sum = 0;
  for (const char* name : {"LeftHand", "RightHand", "LeftFoot", "RightFoot"}) {
    const auto end = world.position(motion.skeleton().find(name)), hips = world.position(0);
    Vec3 mean;
    for (std::size_t t = 0; t < motion.frames(); ++t)
      mean += (end[t] - hips[t]) / static_cast<double>(motion.frames());
    for (std::size_t t = 0; t < motion.frames(); ++t)
      sum += norm(end[t] - hips[t] - mean) / static_cast<double>(4 * motion.frames());
  }
  return sum;
}

TEST_F(CartoonGraphs, ShowTheFiveColumnsOfFigure14SideBySide) {
  KINEGRAPH_NEEDS_MOCAP();
  const std::string graph = source_folder() + "/tests/cartoon/fig14.kg.json";
  const std::string clips = "mocap=" + mocap();
  const std::vector<std::string> columns{"clip", "angles", "positions", "bands", "rubber"};
  std::map<std::string, Motion> motions;
  for (const std::string& column : columns) {
    const Ran ran = run({"get", graph, column + ".motion", "-o", path("out/" + column + ".bvh"), "--var",
                         clips, "--progress", "none"});
    ASSERT_EQ(ran.exit, 0) << ran.err;
    motions.emplace(column, *exported(column + ".bvh").motion());
  }
  const Motion& clip = motions.at("clip");
  for (const auto& [column, motion] : motions) {
    EXPECT_EQ(motion.frames(), clip.frames()) << column;
    // The paper's own rubber has sub-joints; filters keep the skeleton.
    EXPECT_EQ(motion.joints() > clip.joints(), column == "rubber") << column;
    // Angles and bands of angles keep links rigid, positions and rubber stretch them.
    if (column == "positions" || column == "rubber")
      EXPECT_GT(stretch_of(motion), 0.2) << column;
    else
      EXPECT_LT(stretch_of(motion), 1e-4) << column;
    if (column != "clip") {
      EXPECT_GT(swing_of(motion), 1.05 * swing_of(clip)) << column;
    }
    RecordProperty(column, std::to_string(swing_of(motion)) + " m, " + std::to_string(stretch_of(motion)));
  }
  std::vector<std::string> draw{"picture", graph};
  for (const std::string& column : columns) draw.push_back(column + ".motion");
  for (const char* option : {"-o", "", "--var", "", "--progress", "none"}) draw.emplace_back(option);
  draw[draw.size() - 5] = path("fig14.svg");
  draw[draw.size() - 3] = clips;
  const Ran ran = run(draw);
  ASSERT_EQ(ran.exit, 0) << ran.err;
  for (const std::string& column : columns)
    EXPECT_THAT(read("fig14.svg"), testing::HasSubstr(column + ".motion"));
}

TEST_F(CartoonGraphs, GiveMotionsThatPictureCompareAndMetricsTake) {
  KINEGRAPH_NEEDS_MOCAP();
  ASSERT_EQ(run_graph("walk").exit, 0);
  ASSERT_EQ(run({"picture", path("out/walk.bvh"), "-o", path("walk.svg"), "--progress", "none"}).exit, 0);
  EXPECT_THAT(read("walk.svg"), testing::HasSubstr("stretched"));
  const Ran same = run({"compare", path("out/walk.bvh"), path("out/walk.bvh")});
  EXPECT_EQ(same.exit, 0);
  EXPECT_THAT(same.out, testing::HasSubstr("identical"));
  // Through another six-channel BVH and back: no joint moves by over a micrometre.
  write("again.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": "out/walk.bvh"}},
    "bvh": {"type": "Export", "params": {"file": "again.bvh"}, "inputs": {"motion": "clip.motion"}},
    "glb": {"type": "Export", "params": {"file": "again.glb"}, "inputs": {"motion": "clip.motion"}},
    "judge": {"type": "Metrics", "inputs": {"motion": "clip.motion"}},
    "numbers": {"type": "Export", "params": {"file": "numbers.json"}, "inputs": {"metrics": "judge.metrics"}})"));
  const Ran again = run({"run", path("again.kg.json"), "--out", path("out"), "--progress", "none"});
  ASSERT_EQ(again.exit, 0) << again.err;
  EXPECT_TRUE(exists("out/numbers.json"));
  const WorldMotion first = world_motion(*exported("walk.bvh").motion());
  for (const char* file : {"again.bvh", "again.glb"}) {
    const MotionFile other = exported(file);
    const WorldMotion world = world_motion(*other.motion());
    ASSERT_EQ(world.joints(), first.joints()) << file;
    ASSERT_EQ(world.frames(), first.frames()) << file;
    double worst = 0;
    for (int j = 0; j < first.joints(); ++j)
      for (std::size_t t = 0; t < first.frames(); ++t)
        worst = std::max(worst, norm(world.position(j)[t] - first.position(j)[t]));
    EXPECT_LT(worst, 1e-5) << file;
  }
}

TEST_F(CartoonGraphs, PicturesDressACharacterInTheMotionNamedBeforeIt) {
  KINEGRAPH_NEEDS_MOCAP();
  const std::string file = source_folder() + "/tests/cartoon/cesium_man.kg.json";
  const Ran ran =
      run({"picture", file, "clip.motion", "clip.character", "wild.motion", "clip.character", "rubber.motion",
           "rubber.character", "--var", "mocap=" + mocap(), "-o", path("man.svg"), "--progress", "none"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::string picture = read("man.svg");
  EXPECT_THAT(picture, testing::HasSubstr("clip.motion, clip.character"));
  EXPECT_THAT(picture, testing::HasSubstr("wild.motion, clip.character"));
  EXPECT_THAT(picture, testing::HasSubstr("rubber.motion, rubber.character"));
}

}  // namespace
}  // namespace kinegraph
