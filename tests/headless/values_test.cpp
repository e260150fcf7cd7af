// The commands that hand out values: get, picture, compare.
#include "program.h"
#include "tests/mocap.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Values : public ProgramTest {};

std::string walk_and_style() {
  return graph(R"("walk": {"type": "Gait", "params": {"seconds": 3}},
                  "sneak": {"type": "Gait", "params": {"gait": "sneak", "seconds": 3}},
                  "style": {"type": "QuatStats", "inputs": {"motion": "walk.motion"}},
                  "warp": {"type": "TimeWarp", "inputs": {"source": "walk.motion", "reference": "sneak.motion"}})");
}

// Width and height of a PNG, from its header.
std::pair<unsigned, unsigned> size_of_png(const std::string& bytes) {
  auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(Values, GetWritesAnOutputInAnyOfExportsFormats) {
  write("g.kg.json", walk_and_style());
  ASSERT_EQ(run({"get", "g.kg.json", "walk.motion", "-o", "w.bvh"}).exit, 0);
  EXPECT_THAT(read("w.bvh"), StartsWith("HIERARCHY"));
  ASSERT_EQ(run({"get", "g.kg.json", "style.stats", "-o", "s.json"}).exit, 0);
  EXPECT_TRUE(nlohmann::json::accept(read("s.json")));
  const Ran odd = run({"get", "g.kg.json", "walk.motion", "-o", "w.odd"});
  EXPECT_EQ(odd.exit, 2);
  EXPECT_THAT(odd.err, testing::HasSubstr("error: unknown-format: -o w.odd: "));
  EXPECT_EQ(run({"get", "g.kg.json", "walk", "-o", "w.bvh"}).exit, 2);
  EXPECT_EQ(run({"get", "g.kg.json", "walk.moton", "-o", "w.bvh"}).exit, 2);
}

TEST_F(Values, GetMayWriteAnywhereTheCommandLineSays) {
  write("in/g.kg.json", walk_and_style());
  EXPECT_EQ(run({"get", "in/g.kg.json", "walk.motion", "-o", "w.bvh"}).exit, 0);
  EXPECT_TRUE(exists("w.bvh"));
}

TEST_F(Values, PicturesSayWhatTheyShow) {
  write("g.kg.json", walk_and_style());
  struct Shown {
    const char* port;
    std::vector<std::string> words;
  };
  for (const Shown& shown :
       {Shown{"walk.motion", {"walk.motion", "360 frames", "120 fps", "0.00 s", "left", "right"}},
        Shown{"style.stats", {"Spread of each joint", "Hips", "leg length"}},
        Shown{"warp.warp", {"Which frame is shown when", "Slope", "Energy"}}}) {
    Ran ran = run({"picture", "g.kg.json", shown.port, "-o", "p.svg"});
    ASSERT_EQ(ran.exit, 0) << ran.err;
    auto svg = read("p.svg");
    for (const auto& word : shown.words) EXPECT_THAT(svg, HasSubstr(word)) << shown.port;
    ASSERT_EQ(run({"picture", "g.kg.json", shown.port, "-o", "again.svg"}).exit, 0);
    EXPECT_EQ(read("again.svg"), svg) << "the same bytes each time";
    ASSERT_EQ(run({"picture", "g.kg.json", shown.port, "-o", "p.png"}).exit, 0);
    auto [width, height] = size_of_png(read("p.png"));
    EXPECT_GE(width, 1600u);
    EXPECT_GE(height, 400u);
    EXPECT_GT(read("p.png").size(), 20000u);
  }
}

TEST_F(Values, PicturesOfSeveralMotionsStandOneBelowTheOther) {
  write("g.kg.json", walk_and_style());
  ASSERT_EQ(
      run({"picture", "g.kg.json", "walk.motion", "sneak.motion", "-o", "p.svg", "--title", "Before & after"})
          .exit,
      0);
  EXPECT_THAT(read("p.svg"), HasSubstr(">walk.motion<"));
  EXPECT_THAT(read("p.svg"), HasSubstr(">sneak.motion<"));
  EXPECT_THAT(read("p.svg"), HasSubstr("Before &amp; after"));
  EXPECT_EQ(run({"picture", "g.kg.json", "walk.motion", "style.stats", "-o", "p.svg"}).exit, 2);
}

TEST_F(Values, PicturesOfFilesNeedNoGraph) {
  write("g.kg.json", walk_and_style());
  write("m.json", metrics_file(0.0123));
  ASSERT_EQ(run({"get", "g.kg.json", "walk.motion", "-o", "w.bvh"}).exit, 0);
  EXPECT_EQ(run({"picture", "w.bvh", "-o", "w.svg", "--moments", "5"}).exit, 0);
  EXPECT_THAT(read("w.svg"), HasSubstr("360 frames"));
  EXPECT_EQ(run({"picture", "m.json", "-o", "m.svg"}).exit, 0);

  // Moments too close for every one's time to be read tell some of them.
  ASSERT_EQ(run({"picture", "w.bvh", "-o", "many.svg", "--moments", "60"}).exit, 0);
  const std::string many = read("many.svg");
  int times = 0;
  for (std::size_t at = many.find(" s</text>"); at != std::string::npos; at = many.find(" s</text>", at + 1))
    ++times;
  EXPECT_GT(times, 8);
  EXPECT_LT(times, 31);

  // Files of one name are told apart by their folders.
  for (const char* folder : {"a", "b"}) {
    std::filesystem::create_directory(path(folder));
    std::filesystem::copy_file(path("w.bvh"), path(folder) + "/w.bvh");
  }
  ASSERT_EQ(run({"picture", "a/w.bvh", "b/w.bvh", "-o", "both.svg"}).exit, 0);
  EXPECT_NE(read("both.svg").find(">b/w<"), std::string::npos);
  EXPECT_THAT(read("m.svg"), HasSubstr("skate"));
  EXPECT_THAT(read("m.svg"), HasSubstr("0.0123 m/s"));
  EXPECT_THAT(read("m.svg"), HasSubstr("not measured"));
}

TEST_F(Values, PictureMistakes) {
  write("g.kg.json", walk_and_style());
  write("broken.bvh", "HIERARCHY\nROOT\n");
  EXPECT_EQ(run({"picture", "g.kg.json", "walk.motion", "-o", "p.gif"}).exit, 2);
  EXPECT_EQ(run({"picture", "g.kg.json", "-o", "p.svg"}).exit, 2);
  EXPECT_EQ(run({"picture", "none.bvh", "-o", "p.svg"}).exit, 3);
  EXPECT_EQ(run({"picture", "broken.bvh", "-o", "p.svg"}).exit, 3);
  EXPECT_EQ(run({"picture", "g.kg.json", "walk.motion", "-o", "g.kg.json/p.svg"}).exit, 5);
}

TEST_F(Values, CompareTellsHowMotionsDifferAndJudgesByRules) {
  write("g.kg.json", walk_and_style());
  ASSERT_EQ(run({"get", "g.kg.json", "walk.motion", "-o", "a.bvh"}).exit, 0);
  ASSERT_EQ(run({"get", "g.kg.json", "walk.motion", "-o", "b.bvh", "--set", "walk.lean=0.2"}).exit, 0);
  EXPECT_THAT(run({"compare", "a.bvh", "a.bvh"}).out, HasSubstr("identical"));
  Ran differ = run({"compare", "a.bvh", "b.bvh", "--rule", "difference.position_max < 0.0001"});
  EXPECT_EQ(differ.exit, 4);
  EXPECT_THAT(differ.out, HasSubstr("failed  difference.position_max < 0.0001"));
  EXPECT_EQ(run({"compare", "a.bvh", "b.bvh", "--rule", "difference.position_max < 10"}).exit, 0);
  EXPECT_EQ(nlohmann::json::parse(run({"compare", "a.bvh", "a.bvh", "--json"}).out)["identical"], true);
  EXPECT_EQ(run({"compare", "a.bvh", "b.bvh", "--rule", "difference <> 3"}).exit, 2);
  EXPECT_EQ(run({"compare", "a.bvh", "none.bvh"}).exit, 3);
}

TEST_F(Values, CompareRefusesMotionsOfDifferentRates) {
  write("g.kg.json", walk_and_style());
  ASSERT_EQ(run({"get", "g.kg.json", "walk.motion", "-o", "a.bvh"}).exit, 0);
  ASSERT_EQ(run({"convert", "a.bvh", "slow.bvh", "--fps", "24"}).exit, 0);
  const Ran ran = run({"compare", "a.bvh", "slow.bvh"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, HasSubstr("rate-mismatch: a.bvh has 120 frames per second and slow.bvh has 24"));
  EXPECT_THAT(ran.err, HasSubstr("kinegraph convert a.bvh OUT --fps 24"));
  ASSERT_EQ(run({"convert", "a.bvh", "as_slow.bvh", "--fps", "24"}).exit, 0);
  EXPECT_THAT(run({"compare", "as_slow.bvh", "slow.bvh"}).out, HasSubstr("identical"));
}

TEST_F(Values, CompareTakesFilesOfMetrics) {
  write("a.json", metrics_file(0.02));
  write("b.json", metrics_file(0.01));
  Ran ran = run({"compare", "a.json", "b.json", "--rule", "skate < 1.05 * baseline.skate"});
  EXPECT_EQ(ran.exit, 4);
  EXPECT_THAT(ran.out, HasSubstr("skate"));
  EXPECT_EQ(run({"compare", "b.json", "a.json", "--rule", "skate < 1.05 * baseline.skate"}).exit, 0);
  const std::string help = run({"compare", "--help"}).out;
  EXPECT_THAT(help, HasSubstr("rules judge it"));
  EXPECT_THAT(help, HasSubstr("the baseline of rules"));
  EXPECT_THAT(run({"diff", "--help"}).out, testing::Not(HasSubstr("Excludes")));
}

TEST_F(Values, PicturesOfRealClips) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* clip : {"cmu/bvh/08_01.bvh", "bandai/dataset-1_walk_proud_001.bvh", "odd/one_frame.bvh",
                           "odd/derived/frames_zero.bvh", "fair/jumping_jacks.bvh"}) {
    Ran ran = run({"picture", mocap(clip), "-o", "p.svg"});
    EXPECT_EQ(ran.exit, 0) << clip << ran.err;
    EXPECT_THAT(read("p.svg"), HasSubstr(std::string(clip) == "odd/one_frame.bvh" ? "1 frame ·" : "frames"))
        << clip;
  }
}

}  // namespace
}  // namespace kinegraph
