// How much memory the real program takes to read a long clip of each format.
#include "program.h"
#include "tests/sanitized.h"

namespace kinegraph {
namespace {

constexpr int joints = 30;
constexpr std::size_t frames = 30000;

// A chain of joints and one line of angles over and over.
std::string long_bvh(std::size_t count) {
  std::string text = "HIERARCHY\n", line = "0.1234 0.9876 1.2345";
  for (int j = 0; j < joints; ++j) {
    text += (j ? "JOINT j" : "ROOT j") + std::to_string(j) + "\n{\nOFFSET 0 0.06 0\nCHANNELS " +
            (j ? "3" : "6 Xposition Yposition Zposition") + " Zrotation Yrotation Xrotation\n";
    line += " 12.3456 -1.2345 0.1234";
  }
  text += "End Site\n{\nOFFSET 0 0.06 0\n}\n";
  for (int j = 0; j < joints; ++j) text += "}\n";
  text += "MOTION\nFrames: " + std::to_string(count) + "\nFrame Time: 0.008333\n";
  for (std::size_t t = 0; t < count; ++t) text += line + "\n";
  return text;
}

// The same as an .asf and an .amc, whose root is one more.
std::string chain_asf() {
  std::string bones, links;
  for (int j = 0; j < joints - 1; ++j) {
    const std::string name = "j" + std::to_string(j);
    bones += "begin\nid " + std::to_string(j + 1) + "\nname " + name +
             "\ndirection 0 1 0\nlength 0.06\naxis 0 0 0 XYZ\ndof rx ry rz\nend\n";
    links += (j ? "j" + std::to_string(j - 1) : "root") + " " + name + "\n";
  }
  return ":version 1.10\n:name chain\n:units\nmass 1.0\nlength 1.0\nangle deg\n:root\norder TX TY TZ RX RY "
         "RZ\naxis "
         "XYZ\nposition 0 0 0\norientation 0 0 0\n:bonedata\n" +
         bones + ":hierarchy\nbegin\n" + links + "end\n";
}
std::string long_amc(std::size_t count) {
  std::string frame = "root 0.1234 0.9876 1.2345 12.3456 -1.2345 0.1234\n";
  for (int j = 0; j < joints - 1; ++j) frame += "j" + std::to_string(j) + " 12.3456 -1.2345 0.1234\n";
  std::string text = ":FULLY-SPECIFIED\n:DEGREES\n";
  for (std::size_t t = 0; t < count; ++t) text += std::to_string(t + 1) + "\n" + frame;
  return text;
}
class Memory : public ProgramTest {
 protected:
  // Bytes that the program takes at the most which reads that file.
  std::size_t peak_of(const std::string& file) {
    write("g.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": ")" + file + R"("}},
                                "cut": {"type": "Trim", "params": {"range": [0, 4]},
                                        "inputs": {"motion": "clip.motion"}},
                                "out": {"type": "Export", "params": {"file": "out.bvh"},
                                        "inputs": {"motion": "cut.motion"}})"));
    const Ran ran = run({"run", "g.kg.json", "--out", "out", "--threads", "1", "--progress", "none"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.peak;
  }
  void expect_under_three_times(const std::string& few_frames, const std::string& file, int joint_count) {
    const std::size_t without = peak_of(few_frames), with = peak_of(file);
    ASSERT_GT(with, without);
    // Quaternions of all joints and the root's place; neither the file nor the angles as read are counted.
    const std::size_t decoded = frames * static_cast<std::size_t>(4 * joint_count + 3) * sizeof(double);
    RecordProperty("times",
                   std::to_string(static_cast<double>(with - without) / static_cast<double>(decoded)));
    EXPECT_LT(with - without, 3 * decoded);
    EXPECT_GT(with - without, decoded);  // else nothing was measured
  }
};

#define KINEGRAPH_NEEDS_PLAIN_MEMORY() \
  if (sanitized) GTEST_SKIP() << "sanitizers keep memory of their own"

TEST_F(Memory, OfReadingBvhIsUnderThreeTimesTheDecodedMotion) {
  KINEGRAPH_NEEDS_PLAIN_MEMORY();
  write("few.bvh", long_bvh(8));
  write("clip.bvh", long_bvh(frames));
  expect_under_three_times("few.bvh", "clip.bvh", joints);
}

TEST_F(Memory, OfReadingAmcIsUnderThreeTimesTheDecodedMotion) {
  KINEGRAPH_NEEDS_PLAIN_MEMORY();
  write("chain.asf", chain_asf());
  write("few.amc", long_amc(8));
  write("clip.amc", long_amc(frames));
  expect_under_three_times("few.amc", "clip.amc", joints);
}

// Made by another process: what this one ever held counts as the programs' that it starts.
TEST_F(Memory, OfReadingGlbIsUnderThreeTimesTheDecodedMotion) {
  KINEGRAPH_NEEDS_PLAIN_MEMORY();
  write("make.kg.json", graph(R"("long": {"type": "Gait", "params": {"seconds": 250, "fps": 120}},
                                 "few": {"type": "Gait", "params": {"seconds": 0.1, "fps": 120}},
                                 "a": {"type": "Export", "params": {"file": "clip.glb"},
                                       "inputs": {"motion": "long.motion"}},
                                 "b": {"type": "Export", "params": {"file": "few.glb"},
                                       "inputs": {"motion": "few.motion"}})"));
  ASSERT_EQ(run({"run", "make.kg.json", "--out", path(""), "--progress", "none"}).exit, 0);
  expect_under_three_times("few.glb", "clip.glb", 23);
}

}  // namespace
}  // namespace kinegraph
