// pack: a graph to hand on, with everything that it reads, wherever that lay.
#include "program.h"
#include "tests/mocap.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class Pack : public ProgramTest {
 protected:
  // What running a graph writes, or why it didn't.
  std::string made(const std::string& graph, const std::string& file, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"run", graph, "--out", "made"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.exit == 0 ? read("made/" + file) : ran.err;
  }
  void clip(const std::string& file, int seed) {
    write("make.kg.json",
          graph(R"("walk": {"type": "Gait", "params": {"seconds": 0.5, "seed": )" + std::to_string(seed) +
                R"(}}, "out": {"type": "Export", "params": {"file": ")" + file +
                R"("}, "inputs": {"motion": "walk.motion"}})"));
    ASSERT_EQ(run({"run", "make.kg.json"}).exit, 0);
  }
};

TEST_F(Pack, TakesNestedGraphsAndClipsOfOneNameFromManyFolders) {
  clip("a/walk.bvh", 1);
  clip("b/walk.bvh", 2);
  write("lib/blend.kg.json",
        R"({"format": "kinegraph", "schema": 1, "nodes": {
          "own": {"type": "Load", "params": {"file": "../b/walk.bvh"}},
          "mix": {"type": "Blend", "inputs": {"motion": "own.motion", "other": "own.motion"}}},
          "publish": {"inputs": {"motion": "mix.motion"}, "outputs": {"motion": "mix.motion"}}})");
  write("graphs/main.kg.json", graph(R"("walk": {"type": "Load", "params": {"file": "../a/walk.bvh"}},
    "blend": {"type": "Graph", "params": {"file": "../lib/blend.kg.json"}, "inputs": {"motion": "walk.motion"}},
    "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "blend.motion"}})"));
  ASSERT_EQ(run({"pack", "graphs/main.kg.json", "-o", "packed"}).exit, 0);
  EXPECT_THAT(files(), IsSupersetOf({"packed/main.kg.json", "packed/graphs/blend.kg.json",
                                     "packed/clips/walk.bvh", "packed/clips/walk-2.bvh"}));
  fs::rename(path("packed"), path("elsewhere"));
  const std::string there = made("graphs/main.kg.json", "o.bvh");
  for (const char* gone : {"a", "b", "lib", "graphs"}) fs::remove_all(path(gone));
  EXPECT_EQ(made("elsewhere/main.kg.json", "o.bvh", {"--sandbox"}), there);
  EXPECT_EQ(run({"validate", "--strict", "elsewhere/main.kg.json"}).exit, 0);
  EXPECT_EQ(run({"fmt", "--check", "elsewhere/main.kg.json", "elsewhere/graphs/blend.kg.json"}).exit, 0);
}

TEST_F(Pack, FollowsVariablesInPathsAlsoThoseThatANestedFileTakesFromOutside) {
  clip("takes/one/walk.bvh", 1);
  clip("takes/two/walk.bvh", 2);
  write("inner.kg.json",
        R"({"format": "kinegraph", "schema": 1, "variables": {"take": "none"}, "nodes": {
          "clip": {"type": "Load", "params": {"file": "takes/${take}/walk.bvh"}}},
          "publish": {"outputs": {"motion": "clip.motion"}}})");
  write(
      "main.kg.json",
      R"({"format": "kinegraph", "schema": 1, "variables": {"take": "one", "which": "inner.kg.json"}, "nodes": {
    "inner": {"type": "Graph", "params": {"file": "${which}"}},
    "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "inner.motion"}}}})");
  ASSERT_EQ(run({"pack", "main.kg.json", "-o", "one"}).exit, 0);
  ASSERT_EQ(run({"pack", "main.kg.json", "-o", "two", "--var", "take=two"}).exit, 0);
  const std::string one = made("main.kg.json", "o.bvh"),
                    two = made("main.kg.json", "o.bvh", {"--var", "take=two"});
  ASSERT_NE(one, two);
  fs::remove_all(path("takes"));
  fs::remove(path("inner.kg.json"));
  EXPECT_EQ(made("one/main.kg.json", "o.bvh"), one);
  EXPECT_EQ(made("two/main.kg.json", "o.bvh"), two);
}

TEST_F(Pack, KeepsCompanionsWhereTheirFileLooksForThem) {
  // A glTF whose buffer and picture lie in folders of their own.
  clip("walk.gltf", 1);
  auto gltf = read_json("walk.gltf");
  fs::create_directories(path("scene/data"));
  fs::create_directories(path("scene/textures"));
  fs::rename(path(gltf["buffers"][0]["uri"]), path("scene/data/walk.bin"));
  gltf["buffers"][0]["uri"] = "data/walk.bin";
  gltf["images"] = nlohmann::json::array({{{"uri", "textures/skin.png"}}});
  write("scene/walk.gltf", gltf.dump());
  write("scene/textures/skin.png", "\x89PNG\r\n\x1a\n");
  write("main.kg.json", graph(R"("walk": {"type": "Load", "params": {"file": "scene/walk.gltf"}},
    "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "walk.motion"}})"));
  const std::string there = made("main.kg.json", "o.bvh");
  Ran packed = run({"pack", "main.kg.json", "-o", "packed"});
  ASSERT_EQ(packed.exit, 0) << packed.err;
  EXPECT_THAT(files(), IsSupersetOf({"packed/clips/walk/walk.gltf", "packed/clips/walk/data/walk.bin",
                                     "packed/clips/walk/textures/skin.png"}))
      << packed.out;
  fs::remove_all(path("scene"));
  EXPECT_EQ(made("packed/main.kg.json", "o.bvh", {"--sandbox"}), there);
}

TEST_F(Pack, TakesTheSkeletonOfAnAcclaimMotion) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* name : {"17.asf", "17_03.amc", "17_10.amc"})
    fs::create_directories(path("in/17")), fs::copy(mocap(std::string("cmu/asfamc/") + name), path("in/17"));
  write("main.kg.json", graph(R"("a": {"type": "Load", "params": {"file": "in/17/17_03.amc"}},
    "b": {"type": "Load", "params": {"file": "in/17/17_10.amc"}},
    "mix": {"type": "Blend", "inputs": {"motion": "a.motion", "other": "b.motion"}},
    "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "mix.motion"}})"));
  const std::string there = made("main.kg.json", "o.bvh");
  ASSERT_EQ(run({"pack", "main.kg.json", "-o", "packed"}).exit, 0);
  fs::remove_all(path("in"));
  EXPECT_EQ(made("packed/main.kg.json", "o.bvh", {"--sandbox"}), there);
}

TEST_F(Pack, AMissingClipIsToldWithItsNodeAndLineAndNothingIsPacked) {
  clip("walk.bvh", 1);
  write("lib/inner.kg.json", graph(R"("lost": {"type": "Load", "params": {"file": "lost.bvh"}})",
                                   R"("outputs": {"motion": "lost.motion"})"));
  write("main.kg.json", graph(R"("walk": {"type": "Load", "params": {"file": "walk.bvh"}},
    "gone": {"type": "Load", "params": {"file": "gone.bvh"}},
    "inner": {"type": "Graph", "params": {"file": "lib/inner.kg.json"}},
    "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "walk.motion"}})"));
  const Ran ran = run({"pack", "main.kg.json", "-o", "packed"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, HasSubstr("missing-file: gone.file: there is no file \"gone.bvh\""));
  EXPECT_THAT(ran.err, ContainsRegex("main\\.kg\\.json:[0-9]+:[0-9]+: "));
  EXPECT_THAT(ran.err, HasSubstr("missing-file: inner/lost.file: there is no file \"lost.bvh\""));
  EXPECT_THAT(ran.err, ContainsRegex("lib/inner\\.kg\\.json:[0-9]+:[0-9]+: "));
  EXPECT_FALSE(exists("packed"));
}

}  // namespace
}  // namespace kinegraph
