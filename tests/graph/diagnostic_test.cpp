#include "graph/diagnostic.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

TEST(Nearest, FindsASlipOfTheHand) {
  const std::vector<std::string> names{"motion", "reference", "omega", "fps"};
  EXPECT_EQ(nearest("moton", names), "motion");
  EXPECT_EQ(nearest("omgea", names), "omega");
  EXPECT_EQ(nearest("Motion", names), "motion");
  EXPECT_EQ(nearest("FPS", names), "fps");
  EXPECT_EQ(nearest("motions", names), "motion");
}

TEST(Nearest, SaysNothingWhenNothingIsNear) {
  EXPECT_EQ(nearest("weather", {"motion", "fps"}), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("a", {}), "");
}

TEST(Suggestion, NamesTheNearestOrAll) {
  EXPECT_EQ(suggestion("moton", {"motion", "points"}), "did you mean \"motion\"?");
  EXPECT_EQ(suggestion("weather", {"motion", "points"}), "there is motion, points");
}

TEST(Diagnostic, ReadsAsOneLine) {
  EXPECT_EQ(to_text(error("unknown-port", "there is no port \"moton\"")
                        .in_file("a.kg.json", {3, 7})
                        .at_node("warp")
                        .at_port("moton")
                        .hinting("did you mean \"motion\"?")),
            "a.kg.json:3:7: error: unknown-port: warp.moton: there is no port \"moton\" (did you mean "
            "\"motion\"?)");
  EXPECT_EQ(to_text(warning("spike", "a jump").at_joint("Hips").at_frame(3)),
            "warning: spike: joint Hips, frame 3: a jump");
}

TEST(Diagnostic, LeavesOutOfItsJsonWhatIsEmpty) {
  EXPECT_EQ(compact(to_json(error("x", "y").at_frame(0))),
            R"({"code": "x", "frame": 0, "message": "y", "severity": "error"})");
}

}  // namespace
}  // namespace kinegraph
