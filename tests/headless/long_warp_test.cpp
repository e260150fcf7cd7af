// TimeWarp of clips of minutes: 20,000 frames on 20,000 in the real program, its memory and how it ends
// early.
#include <signal.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "program.h"
#include "tests/sanitized.h"

namespace kinegraph {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t frames = 20000;

class LongWarp : public ProgramTest {
 protected:
  // "a" and "b" (Gaits at 120 frames a second) -> "warp" -> "out" (Export, warped.bvh).
  void SetUp() override {
    write("g.kg.json", graph(R"("a": {"type": "Gait", "params": {"seconds": 166.6667}},
                   "b": {"type": "Gait", "params": {"gait": "sneak", "seconds": 166.6667, "seed": 5}},
                   "warp": {"type": "TimeWarp", "inputs": {"source": "a.motion", "reference": "b.motion"}},
                   "out": {"type": "Export", "params": {"file": "warped.bvh"},
                           "inputs": {"motion": "warp.warped"}})"));
  }

  // So that it is the warp that is at work when the end comes, however slow the machine is.
  void make_gaits() {
    ASSERT_EQ(
        run({"run", "g.kg.json", "--cache", "cache", "--target", "a.motion", "--target", "b.motion"}).exit,
        0);
    write("out/kept.txt", "there before");
  }
  void expect_cancelled(int exit) {
    const auto report = read_json("r.json");
    EXPECT_EQ(report["exit"], exit);
    EXPECT_EQ(report["nodes"]["a"]["state"], "done");
    EXPECT_EQ(report["nodes"]["warp"]["state"], "cancelled");
    EXPECT_EQ(report["nodes"]["out"]["state"], "cancelled");
    EXPECT_THAT(report["files"], IsEmpty());
    auto left = files();
    std::erase_if(left, [](const std::string& file) { return file.starts_with("cache"); });
    EXPECT_THAT(left, ElementsAre("g.kg.json", "out", "out/kept.txt", "r.json"));
    EXPECT_EQ(run({"cache", "verify", "--cache", "cache"}).exit, 0);
    EXPECT_THAT(run({"cache", "stat", "--cache", "cache"}).out, HasSubstr("2 entries"));
    EXPECT_EQ(read("out/kept.txt"), "there before");
  }
};

TEST_F(LongWarp, OfTwentyThousandFramesStaysUnder400MiB) {
  if (sanitized) GTEST_SKIP() << "sanitizers keep memory of their own";
  const Ran ran = run({"run", "g.kg.json", "--set", "warp.iterations=1", "--out", "out", "--report", "r.json",
                       "--threads", "2", "--progress", "none"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  std::istringstream lines(read("out/warped.bvh"));
  std::string line;
  while (std::getline(lines, line) && !line.starts_with("Frames:")) {
  }
  EXPECT_EQ(line, "Frames: " + std::to_string(frames));
  RecordProperty("MiB", static_cast<int>(ran.peak >> 20));
  EXPECT_LT(ran.peak, std::size_t{400} << 20);
  EXPECT_GT(ran.peak,
            2 * frames * 20 * 4 * sizeof(double));  // what both motions hold, else nothing was measured
}

TEST_F(LongWarp, EndsAtSigintWith130AndNothingHalfWritten) {
  make_gaits();
  const auto running = start(
      {"run", "g.kg.json", "--cache", "cache", "--out", "out", "--report", "r.json", "--progress", "json"});
  // The signal must find the warp at work.
  bool at_work = false;
  for (int i = 0; i < 3000 && !at_work; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::ifstream told(running.err);
    for (std::string line; std::getline(told, line);)
      at_work = at_work || (line.find(R"("warp")") != line.npos && line.find(R"("running")") != line.npos);
  }
  ASSERT_TRUE(at_work);
  kill(running.process, SIGINT);
  EXPECT_EQ(wait(running).exit, 130);
  expect_cancelled(130);
}

TEST_F(LongWarp, EndsAtItsTimeOutWith124AndNothingHalfWritten) {
  make_gaits();
  const Ran ran =
      run({"run", "g.kg.json", "--cache", "cache", "--out", "out", "--report", "r.json", "--timeout", "0.7"});
  EXPECT_EQ(ran.exit, 124);
  expect_cancelled(124);
}

}  // namespace
}  // namespace kinegraph
