// A clip's style on characters of other makes, from real files to GLB and BVH.
#include "program.h"
#include "tests/mocap.h"

namespace kinegraph {
namespace {

class RetargetGraph : public ProgramTest {};

TEST_F(RetargetGraph, gives_real_characters_the_style_of_a_real_clip) {
  KINEGRAPH_NEEDS_MOCAP();
  const Ran ran = run({"run", KINEGRAPH_SOURCE_DIR "/tests/headless/style_onto_characters.kg.json", "--var",
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

}  // namespace
}  // namespace kinegraph
