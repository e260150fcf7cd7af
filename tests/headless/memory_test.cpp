// How much memory the real program takes to read a long clip.
#include "program.h"

namespace kinegraph {
namespace {

class Memory : public ProgramTest {};

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

TEST_F(Memory, OfReadingIsUnderThreeTimesTheDecodedMotion) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep memory of their own";
#endif
  auto peak_of = [&](std::size_t count) {
    write("clip.bvh", long_bvh(count));
    write("g.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": "clip.bvh"}},
                                "cut": {"type": "Trim", "params": {"range": [0, 4]},
                                        "inputs": {"motion": "clip.motion"}},
                                "out": {"type": "Export", "params": {"file": "out.bvh"},
                                        "inputs": {"motion": "cut.motion"}})"));
    const Ran ran = run({"run", "g.kg.json", "--out", "out", "--threads", "1", "--progress", "none"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.peak;
  };
  const std::size_t without = peak_of(8), with = peak_of(frames);
  ASSERT_GT(with, without);
  // Quaternions of all joints and the root's place; neither the text nor the angles as read are counted.
  const std::size_t decoded = frames * (4 * joints + 3) * sizeof(double);
  EXPECT_LT(with - without, 3 * decoded);
  EXPECT_GT(with - without, decoded);  // else nothing was measured
}

}  // namespace
}  // namespace kinegraph
