// A clip's style on characters of other makes, from real files to GLB and BVH.
#include <algorithm>

#include "nodes/files/motion_file.h"
#include "nodes/motion/character.h"
#include "program.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

class RetargetGraph : public ProgramTest {};

TEST_F(RetargetGraph, gives_real_characters_the_style_of_a_real_clip) {
  KINEGRAPH_NEEDS_MOCAP();
  const Ran ran = run({"run", source_folder() + "/tests/headless/style_onto_characters.kg.json", "--var",
                       "mocap=" + mocap(), "--out", path("out"), "--report", path("report.json")});
  EXPECT_EQ(ran.exit, 0) << ran.out << ran.err;
  const auto report = read_json("report.json");
  EXPECT_EQ(report["checks"].size(), 3u);
  for (const auto& check : report["checks"]) EXPECT_TRUE(check["passed"].get<bool>()) << check.dump();
  EXPECT_EQ(report["files"].size(), 4u);
  // Both formats hold the same motion.
  for (const std::string who : {"man", "mannequin"}) {
    const auto compared = nlohmann::json::parse(
        run({"compare", "--json", path("out/" + who + "_sneaks.glb"), path("out/" + who + "_sneaks.bvh")})
            .out);
    EXPECT_LT(compared["position_max"].get<double>(), 1e-4);
    EXPECT_EQ(compared["only_a"].size() + compared["only_b"].size(), 0u);
    const auto info = nlohmann::json::parse(run({"info", "--json", path("out/" + who + "_sneaks.glb")}).out);
    EXPECT_GT(info["frames"].get<int>(), 200) << info.dump();
  }
}

// What a person sees of the saved graph: the figure's shoes on the ground, nowhere far below it.
TEST_F(RetargetGraph, keeps_the_figures_soles_on_the_ground) {
  const Ran ran =
      run({"run", source_folder() + "/graphs/retarget.kg.json", "--out", path("out"), "--progress", "none"});
  ASSERT_EQ(ran.exit, 0) << ran.out << ran.err;
  PlainFiles files;
  Alone work;
  const MotionFile file = read_motion_file(path("out/mannequin_sneaks.glb"), {}, files, work);
  const auto& character = dynamic_cast<const Character&>(*file.find("character"));
  std::vector<double> lows;
  for (std::size_t t = 0; t < file.motion()->frames(); t += 2) {
    lows.push_back(1e9);
    const Pose pose = pose_for(character, *file.motion(), t);
    for (const MeshPart& part : character.parts)
      for (const Vec3 v : posed_vertices(character, part, pose)) lows.back() = std::min(lows.back(), v.y);
  }
  std::sort(lows.begin(), lows.end());
  EXPECT_GT(lows.front(), -0.06);  // at toe-off, after Footskate has lowered the hips; 0.073 without `soles`
  EXPECT_NEAR(lows[lows.size() / 2], 0, 0.015);
  EXPECT_LT(lows.back(), 0.03);
}

// The saved graph with other files: every style goes onto every character, whatever names either has.
TEST_F(RetargetGraph, gives_every_character_the_style_of_every_clip) {
  KINEGRAPH_NEEDS_MOCAP();
  struct Clips {
    const char *source, *style;
  };
  const Clips pairs[] = {{"cmu/bvh/08_01.bvh", "cmu/asfamc/17_03.amc"},
                         {"cmu/asfamc/16_31.amc", "xia/strutting_01_000.bvh"},
                         {"xia/neutral_01_000.bvh", "cmu/bvh/104_HappyStartWalk_3.bvh"}};
  const std::string characters[] = {mocap("gltf/CesiumMan.glb"), mocap("gltf/RiggedFigure.glb"),
                                    mocap("gltf/KayKit_Knight.glb"),
                                    source_folder() + "/graphs/characters/mannequin.glb"};
  for (const std::string& character : characters)
    for (const auto& [source, style] : pairs) {
      SCOPED_TRACE(character + ": " + source + " in the style of " + style);
      const auto drop = [](const std::string& clip) {
        return std::string(clip.starts_with("cmu/bvh") ? "drop" : "keep");
      };
      const Ran ran =
          run({"run", source_folder() + "/graphs/retarget.kg.json", "--set", "source=" + mocap(source),
               "--set", "style=" + mocap(style), "--set", "character=" + character, "--set",
               "walk.rest_frame=" + drop(source), "--set", "sneak.rest_frame=" + drop(style), "--out",
               path("out"), "--report", path("report.json"), "--progress", "none"});
      EXPECT_EQ(ran.exit, 0) << ran.out << ran.err;
      // Its rules: half the distance in style or less, and no skating.
      const auto checks = read_json("report.json")["checks"];
      EXPECT_EQ(checks.size(), 2u);
      for (const auto& check : checks) EXPECT_TRUE(check["passed"].get<bool>()) << check.dump();
    }
}

}  // namespace
}  // namespace kinegraph
