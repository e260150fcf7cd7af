// How much memory the real program takes to read a long clip of each format.
#include "nodes/files/motion_file.h"
#include "program.h"

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
// Float32 keys of every joint at every frame.
std::string long_glb(std::size_t count) {
  auto skeleton = std::make_shared<Skeleton>();
  for (int j = 0; j < joints; ++j)
    skeleton->joints.push_back({"j" + std::to_string(j), j - 1, {0, 0.06, 0}, {}});
  Motion motion(skeleton, std::make_shared<SourceFacts>(), 120, count, {true});
  for (int j = 0; j < joints; ++j)
    for (std::size_t t = 0; t < count; ++t)
      motion.rotation(j).set(t, axis_angle({0, 0, 1}, 0.3 * static_cast<double>(t % 100) / 100));
  for (std::size_t t = 0; t < count; ++t)
    motion.translation(0).set(t, {0.001 * static_cast<double>(t), 1, 0});
  Alone work;
  return encode_motion_file("clip.glb", "glb",
                            {{"motion", std::make_shared<const Motion>(std::move(motion))}}, {}, work)
      .bytes;
}

class Memory : public ProgramTest {
 protected:
  // Bytes that reading `count` frames takes at the most.
  std::size_t peak_of(const std::string& file, const std::string& bytes) {
    write(file, bytes);
    write("g.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": ")" + file + R"("}},
                                "cut": {"type": "Trim", "params": {"range": [0, 4]},
                                        "inputs": {"motion": "clip.motion"}},
                                "out": {"type": "Export", "params": {"file": "out.bvh"},
                                        "inputs": {"motion": "cut.motion"}})"));
    const Ran ran = run({"run", "g.kg.json", "--out", "out", "--threads", "1", "--progress", "none"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.peak;
  }
  static void expect_under_three_times(std::size_t without, std::size_t with) {
    ASSERT_GT(with, without);
    // Quaternions of all joints and the root's place; neither the file nor the angles as read are counted.
    const std::size_t decoded = frames * (4 * joints + 3) * sizeof(double);
    RecordProperty("times",
                   std::to_string(static_cast<double>(with - without) / static_cast<double>(decoded)));
    EXPECT_LT(with - without, 3 * decoded);
    EXPECT_GT(with - without, decoded);  // else nothing was measured
  }
};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define KINEGRAPH_NEEDS_PLAIN_MEMORY() GTEST_SKIP() << "sanitizers keep memory of their own"
#else
#define KINEGRAPH_NEEDS_PLAIN_MEMORY()
#endif

TEST_F(Memory, OfReadingBvhIsUnderThreeTimesTheDecodedMotion) {
  KINEGRAPH_NEEDS_PLAIN_MEMORY();
  expect_under_three_times(peak_of("clip.bvh", long_bvh(8)), peak_of("clip.bvh", long_bvh(frames)));
}

TEST_F(Memory, OfReadingAmcIsUnderThreeTimesTheDecodedMotion) {
  KINEGRAPH_NEEDS_PLAIN_MEMORY();
  write("clip.asf", chain_asf());
  expect_under_three_times(peak_of("clip.amc", long_amc(8)), peak_of("clip.amc", long_amc(frames)));
}

TEST_F(Memory, OfReadingGlbIsUnderThreeTimesTheDecodedMotion) {
  KINEGRAPH_NEEDS_PLAIN_MEMORY();
  expect_under_three_times(peak_of("clip.glb", long_glb(8)), peak_of("clip.glb", long_glb(frames)));
}

}  // namespace
}  // namespace kinegraph
