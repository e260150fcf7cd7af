// Readers on thousands of damaged files, always the same ones: a Failure or a motion, never a crash or a
// hang. The fuzzers in tests/fuzz go on from here with a sanitizer.
#include <gtest/gtest.h>

#include <random>

#include "nodes/files/analysis_file.h"
#include "nodes/motion/metrics.h"
#include "tests/fuzz/read_once.h"
#include "tests/nodes/files/bvh_texts.h"

namespace kinegraph {
namespace {

const char* const splices[] = {"-",
                               "nan",
                               "1e999",
                               "1e-999",
                               "-1e300",
                               ",",
                               "{",
                               "}",
                               "\n",
                               "\r\n",
                               "\t",
                               "ROOT a",
                               "JOINT",
                               "End Site",
                               "MOTION",
                               "Frames: 9",
                               "99999999999999999999",
                               "0x1",
                               "1e9",
                               "CHANNELS 7",
                               "\xFF\xFE",
                               "root",
                               ":bonedata",
                               "begin",
                               "end",
                               "dof rx ry rz l",
                               "axis 1 2 3 ZYX",
                               "[",
                               "\"",
                               "e",
                               "+"};

std::string mutated(std::string text, std::mt19937& random) {
  auto below = [&](std::size_t n) { return n ? random() % n : 0; };
  for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
    const std::size_t at = below(text.size() + 1);
    switch (below(6)) {
      case 0:
        text.erase(at, below(12));
        break;
      case 1:
        text.insert(at, splices[below(std::size(splices))]);
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random());
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        text.insert(at, text.substr(below(text.size() + 1), below(60)));
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
    }
  }
  return text;
}

TEST(Mutations, OfABvhNeverCrashTheReader) {
  std::mt19937 random(1);
  const std::string sources[] = {
      small_bvh(two_frames()),
      small_bvh("Frames: 2\nFrame Time: .0083333\n30 1 10 2 5 6 7 8\n31 1 10 2.5e-3 5 6 7 8\n",
                "4 Xrotation Zposition Yrotation Yposition", "4 Xrotation Yrotation Xrotation Zrotation")};
  for (const std::string& source : sources) ASSERT_TRUE(read_bvh_once(source));
  int read = 0;
  for (int i = 0; i < 6000; ++i) read += read_bvh_once(mutated(sources[i % 2], random));
  EXPECT_GT(read, 100);  // both ways are taken
  EXPECT_LT(read, 5700);
}

TEST(Mutations, OfAnAcclaimPairNeverCrashTheReader) {
  const std::string asf =
      ":version 1.10\n:units\n length 0.45\n angle deg\n:root\n order TX TY TZ RX RY RZ\n axis XYZ\n "
      "position 0 0 0\n"
      " orientation 0 0 0\n:bonedata\n begin\n name thigh\n direction 0 -1 0\n length 7\n axis 0 0 90 XYZ\n "
      "dof rx rz\n"
      " limits (-160.0 20.0)\n (-70.0 70.0)\n end\n begin\n name shin\n direction 0 -1 0\n length 6\n axis 0 "
      "0 0 XYZ\n dof rx tx\n"
      " end\n:hierarchy\n begin\n root thigh\n thigh shin\n end\n";
  const std::string amc =
      ":FULLY-SPECIFIED\n:DEGREES\n1\nroot 1 2 3 10 20 30\nthigh 40 50\nshin 60 1\n2\nroot 1 2 3 10 20 30\n"
      "thigh 40 50\nshin 61 2\n";
  ASSERT_TRUE(read_amc_once(asf, amc));
  std::mt19937 random(2);
  int read = 0;
  for (int i = 0; i < 6000; ++i)
    read += i % 2 ? read_amc_once(asf, mutated(amc, random)) : read_amc_once(mutated(asf, random), amc);
  EXPECT_GT(read, 300);
  EXPECT_LT(read, 5700);
}

TEST(Mutations, OfAnAnalysisNeverCrashTheReader) {
  Alone work;
  Metrics metrics;
  metrics.all = {{"skate", 0.25, "m/s"}, {"jerk", {}, "m/s³"}};
  const std::string text = write_analysis(*kind_of_port("metrics"), metrics, work);
  std::mt19937 random(3);
  int read = 0;
  for (int i = 0; i < 3000; ++i) read += read_analysis_once(mutated(text, random));
  EXPECT_LT(read, 2900);
}

}  // namespace
}  // namespace kinegraph
