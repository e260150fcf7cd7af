// `kinegraph info` and `kinegraph convert`, as a script runs them.
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/mocap.h"
#include "tests/nodes/files/bvh_texts.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

class FileCommands : public testing::Test {
 protected:
  FileCommands() {
    std::string pattern = (std::filesystem::temp_directory_path() / "kinegraph-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    std::ofstream(folder_ + "/clip.bvh") << small_bvh(two_frames());
    std::ofstream(folder_ + "/broken.bvh")
        << small_bvh("Frames: 1\nFrame Time: 0.04\n1 2 x 10 20 30 -5 6 7\n");
  }
  ~FileCommands() override { std::filesystem::remove_all(folder_); }

  struct Ran {
    int exit;
    std::string output;
  };
  // `streams`: "2>&1" for both, "2>/dev/null" for the results alone.
  Ran run(const std::string& arguments, const std::string& streams) {
    const std::string command =
        "cd " + folder_ + " && " + bin_folder() + "/kinegraph " + arguments + " " + streams;
    FILE* pipe = popen(command.c_str(), "r");
    std::string output;
    for (int c; (c = std::fgetc(pipe)) != EOF;) output += static_cast<char>(c);
    const int status = pclose(pipe);
    return {WEXITSTATUS(status), output};
  }
  std::string bytes_of(const std::string& name) {
    std::ifstream in(folder_ + "/" + name, std::ios::binary);
    std::stringstream bytes;
    bytes << in.rdbuf();
    return bytes.str();
  }
  std::string folder_;
};

TEST_F(FileCommands, InfoTellsWhatAFileHolds) {
  const Ran text = run("info clip.bvh", "2>/dev/null");
  EXPECT_EQ(text.exit, 0);
  for (const char* part : {"2 at 25 a second", "2 joints, 1 End Sites", "\n  Leg ", "unit-found",
                           "breaks    no flips", "feet      too few frames"})
    EXPECT_NE(text.output.find(part), std::string::npos) << text.output;
  const Ran json = run("info clip.bvh --json", "2>/dev/null");
  EXPECT_EQ(json.exit, 0);
  const auto facts = nlohmann::json::parse(json.output);
  EXPECT_EQ(facts["frames"], 2);
  EXPECT_EQ(facts["fps"], 25);
  EXPECT_EQ(facts["joints"][1]["name"], "Leg");
  EXPECT_EQ(facts["joints"][1]["channels"][0], "Zrotation");
}

TEST_F(FileCommands, InfoPointsIntoABrokenFile) {
  const Ran broken = run("info broken.bvh", "2>&1");
  EXPECT_EQ(broken.exit, 3);
  EXPECT_NE(broken.output.find("broken.bvh:19:5: error: bad-number"), std::string::npos) << broken.output;
  EXPECT_EQ(run("info nothing.bvh", "2>&1").exit, 3);
}

TEST_F(FileCommands, ConvertChangesUnitAndRate) {
  EXPECT_EQ(run("convert clip.bvh new/out.bvh --unit m --out-unit cm --fps 50", "2>&1").exit, 0);
  const std::string out = bytes_of("new/out.bvh");
  EXPECT_NE(out.find("OFFSET 0 -80 10"), std::string::npos) << out;
  EXPECT_NE(out.find("Frames: 3\nFrame Time: 0.02\n"), std::string::npos) << out;
  EXPECT_NE(out.find("\n125.000000 200.000000 300.000000 "), std::string::npos) << out;
}

TEST_F(FileCommands, ConvertTakesWhatTheOtherFormatCanHold) {
  // A motion becomes the points of its joints, and goes through all formats of points.
  EXPECT_EQ(run("convert clip.bvh joints.csv --unit m", "2>&1").exit, 0);
  for (const char* ending : {"c3d", "trc", "csv"}) {
    EXPECT_EQ(run(std::string("convert joints.csv again.") + ending, "2>&1").exit, 0) << ending;
    const Ran back = run(std::string("convert again.") + ending + " back.csv", "2>&1");
    EXPECT_EQ(back.exit, 0) << back.output;
  }
  EXPECT_NE(bytes_of("back.csv").find("Leg.x"), std::string::npos);
  // A skinned character's motion alone is what a BVH holds.
  if (!std::filesystem::exists(mocap("gltf/Fox.glb"))) return;
  const Ran fox = run("convert " + mocap("gltf/Fox.glb") + " fox.bvh", "2>&1");
  EXPECT_EQ(fox.exit, 0) << fox.output;
  EXPECT_NE(fox.output.find("bvh can't hold character"), std::string::npos) << fox.output;
  EXPECT_EQ(bytes_of("fox.bvh").substr(0, 9), "HIERARCHY");
}

TEST_F(FileCommands, ConvertRefusesWhatItCannotDo) {
  EXPECT_EQ(run("convert clip.bvh out.json", "2>&1").exit, 3);
  EXPECT_EQ(run("convert clip.bvh out.bvh --unit furlong", "2>&1").exit, 2);
  EXPECT_EQ(run("convert clip.bvh /proc/none/out.bvh", "2>&1").exit, 5);
  EXPECT_EQ(run("convert clip.bvh", "2>&1").exit, 2);
}

TEST_F(FileCommands, HintsNameWhoseSettingsTheyMean) {
  std::ofstream(folder_ + "/none") << "no motion";
  for (const char* command :
       {"info none", "convert none out.bvh", "compare none none", "picture none -o p.svg"}) {
    const Ran ran = run(command, "2>&1");
    EXPECT_NE(ran.exit, 0) << command;
    EXPECT_NE(ran.output.find("name it by Load's format"), std::string::npos) << ran.output;
  }
  for (const char* command : {"info clip.bvh", "convert clip.bvh out.bvh"})
    EXPECT_NE(run(command, "2>&1").output.find("by Load's unit or convert's --unit"), std::string::npos)
        << command;
  EXPECT_NE(run("convert clip.bvh out.xyz", "2>&1").output.find("(give it another ending"),
            std::string::npos);
  if (!std::filesystem::exists(mocap("gltf/Fox.glb"))) return;
  const Ran clips = run("convert " + mocap("gltf/Fox.glb") + " fox.bvh", "2>&1");
  EXPECT_NE(clips.output.find("by Load's clip"), std::string::npos) << clips.output;
  const Ran rest = run("convert " + mocap("cmu/bvh/08_01.bvh") + " out.bvh", "2>&1");
  EXPECT_NE(rest.output.find("Load's rest_frame drop leaves it out"), std::string::npos) << rest.output;
}

TEST_F(FileCommands, ConvertNeverWritesOntoWhatItReads) {
  const std::string before = bytes_of("clip.bvh");
  for (const char* same : {"clip.bvh", "./clip.bvh", "new/../clip.bvh"}) {
    const Ran ran = run(std::string("convert clip.bvh ") + same + " --fps 50", "2>&1");
    EXPECT_EQ(ran.exit, 3) << ran.output;
    EXPECT_NE(ran.output.find("error: writes-onto-input: "), std::string::npos) << ran.output;
    EXPECT_EQ(bytes_of("clip.bvh"), before);
  }
}

}  // namespace
}  // namespace kinegraph
