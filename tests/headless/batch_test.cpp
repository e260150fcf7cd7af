// batch: one graph over many clips.
#include <unistd.h>

#include <csignal>
#include <map>

#include "program.h"
#include "tests/mocap.h"

namespace kinegraph {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class BatchTest : public ProgramTest {
 protected:
  void SetUp() override {
    for (const char* name : {"a", "b", "c"}) {
      write("make.kg.json", graph(std::string(R"("walk": {"type": "Gait", "params": {"seconds": 0.)") +
                                  std::to_string(name[0] - 'a' + 5) +
                                  R"(}}, "out": {"type": "Export", "params": {"file": "clips/)" +
                                  (name[0] == 'c' ? "more/" : "") + name +
                                  R"(.bvh"}, "inputs": {"motion": "walk.motion"}})"));
      ASSERT_EQ(run({"run", "make.kg.json"}).exit, 0);
    }
    write("g.kg.json", batch_graph("smooth.bvh"));
  }
  static std::string batch_graph(const std::string& file) {
    return graph(R"("clip": {"type": "Load", "params": {"file": "clips/a.bvh"}},
      "smooth": {"type": "Filter", "inputs": {"motion": "clip.motion"}},
      "out": {"type": "Export", "params": {"file": ")" +
                 file + R"("}, "inputs": {"motion": "smooth.motion"}})");
  }
  Ran batch(std::vector<std::string> more, std::vector<std::string> environment = {}) {
    std::vector<std::string> all{"batch", "g.kg.json", "--each", "clip.file=clips/**/*.bvh", "--out", "done"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all, std::move(environment));
  }
};

TEST_F(BatchTest, EveryClipGetsAFolderOfItsOwn) {
  Ran ran = batch({"--report", "report.json"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("3 items: 3 done"));
  EXPECT_EQ(ran.err, "") << "item and index are the batch's own: nobody is warned that they are not used";
  EXPECT_TRUE(exists("done/a/smooth.bvh"));
  EXPECT_TRUE(exists("done/more/c/smooth.bvh"));
  EXPECT_TRUE(exists("done/.kinegraph/more/c.json"));
  EXPECT_EQ(read_json("report.json")["items"].size(), 3u);
  EXPECT_EQ(read_json("report.json")["items"]["a"]["report"]["files"][0]["path"], "a/smooth.bvh");
}

TEST_F(BatchTest, AnExportMayNameItsItem) {
  write("g.kg.json", batch_graph("all/${item}_${index}.bvh"));
  EXPECT_EQ(batch({}).exit, 0);
  EXPECT_TRUE(exists("done/all/a_0.bvh"));
  EXPECT_TRUE(exists("done/all/more/c_2.bvh"));
}

TEST_F(BatchTest, AFailureDoesNotStopTheRest) {
  write("clips/b.bvh", "HIERARCHY nonsense");
  Ran ran = batch({"--report", "report.json", "--junit", "junit.xml"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_THAT(ran.out, HasSubstr("failed  b   clip: "));
  EXPECT_TRUE(exists("done/a/smooth.bvh"));
  EXPECT_TRUE(exists("done/more/c/smooth.bvh"));
  EXPECT_FALSE(exists("done/.kinegraph/b.json"));
  EXPECT_EQ(read_json("report.json")["items"]["b"]["state"], "failed");
  EXPECT_THAT(read("junit.xml"), HasSubstr("<testsuite name=\"b: g.kg.json\""));
}

TEST_F(BatchTest, OfAFailedItemTheCauseIsToldAndNotAllThatItBlocked) {
  write("clips/b.bvh", "HIERARCHY nonsense");
  const Ran ran = batch({"--report", "report.json"});
  EXPECT_THAT(ran.err, HasSubstr("b: clips/b.bvh:"));
  EXPECT_THAT(ran.err, Not(HasSubstr("blocked")));
  EXPECT_EQ(read_json("report.json")["items"]["b"]["report"]["nodes"]["smooth"]["state"], "blocked");
}

TEST_F(BatchTest, AWarningOfManyItemsIsToldForThreeAndCounted) {
  write("g.kg.json", graph(R"("walk": {"type": "Gait", "params": {"seconds": 0.5}},
      "m": {"type": "Metrics", "inputs": {"motion": "walk.motion"}},
      "judge": {"type": "Check", "params": {"rules": ["skat < 1"]}, "inputs": {"metrics": "m.metrics"}})"));
  write("table.csv", "walk.seed\n1\n2\n3\n4\n5\n");
  const Ran ran = run({"batch", "g.kg.json", "--table", "table.csv", "--out", "done", "--report", "r.json"});
  EXPECT_EQ(ran.exit, 4) << ran.err;
  std::size_t told = 0;
  for (std::size_t at = ran.err.find("unknown-metric"); at != ran.err.npos;
       at = ran.err.find("unknown-metric", at + 1))
    ++told;
  EXPECT_EQ(told, 4u) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("warning: unknown-metric: judge.rules: 2 more items have it"));
  EXPECT_THAT(ran.out, HasSubstr("judge: skat < 1 could not be measured"));
  const auto report = read_json("r.json");
  EXPECT_EQ(report["items"].size(), 5u);
  for (const auto& item : report["items"]) {
    EXPECT_EQ(item["report"]["nodes"]["judge"]["diagnostics"].size(), 1u);
    EXPECT_EQ(item["cause"], "judge: skat < 1 could not be measured");
  }
}

TEST_F(BatchTest, ResumeSkipsWhatStillAgrees) {
  ASSERT_EQ(batch({}).exit, 0);
  EXPECT_THAT(batch({"--resume"}).out, HasSubstr("3 skipped"));
  // A file that is gone, a file that was changed and a clip that was changed are made again.
  std::filesystem::remove(path("done/a/smooth.bvh"));
  write("done/b/smooth.bvh", "changed");
  EXPECT_THAT(batch({"--resume"}).out, HasSubstr("2 done, 1 skipped"));
  EXPECT_THAT(read("done/b/smooth.bvh"), Not(testing::StrEq("changed")));
  write("clips/a.bvh", read("clips/b.bvh"));
  EXPECT_THAT(batch({"--resume"}).out, HasSubstr("1 done, 2 skipped"));
  EXPECT_THAT(batch({"--resume", "--set", "smooth.cutoff=3"}).out, HasSubstr("3 done"));
}

TEST_F(BatchTest, ListsGoInStepOrAreCrossed) {
  std::vector<std::string> two{"batch", "g.kg.json", "--each",   "clip.file=clips/?.bvh",
                               "--out", "done",      "--dry-run"};
  std::vector<std::string> with_three = two;
  with_three.insert(with_three.end(), {"--each", "clip.file=clips/**/*.bvh"});
  EXPECT_EQ(run(with_three).exit, 2);
  with_three.push_back("--cross");
  Ran crossed = run(with_three);
  EXPECT_EQ(crossed.exit, 0) << crossed.err;
  EXPECT_THAT(crossed.out, HasSubstr("item  a+more/c\n"));
}

TEST_F(BatchTest, ATableSetsWhatItsHeaderNames) {
  write("table.csv",
        "item,clip.file,smooth.cutoff\r\nslow,clips/a.bvh,2\r\n\"fast, really\",clips/b.bvh,9\r\n");
  Ran ran = run({"batch", "g.kg.json", "--table", "table.csv", "--out", "done"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(exists("done/slow/smooth.bvh"));
  EXPECT_TRUE(exists("done/fast, really/smooth.bvh"));
}

TEST_F(BatchTest, ShardsShareTheItemsAndTheirReportsBecomeOne) {
  EXPECT_EQ(batch({"--shard", "0/2", "--report", "r0.json"}).exit, 0);
  EXPECT_EQ(batch({"--report", "r.json"}, {"SLURM_ARRAY_TASK_ID=5", "SLURM_ARRAY_TASK_MIN=3",
                                           "SLURM_ARRAY_TASK_STEP=2", "SLURM_ARRAY_TASK_COUNT=2"})
                .exit,
            0);
  const auto first = read_json("r0.json")["items"], second = read_json("r.1.json")["items"];
  EXPECT_EQ(first.size() + second.size(), 3u);
  EXPECT_EQ(run({"batch", "--merge-reports", "r0.json", "r.1.json", "-o", "all.json"}).exit, 0);
  EXPECT_EQ(read_json("all.json")["items"].size(), 3u);
  EXPECT_EQ(read_json("all.json")["started"], read_json("r0.json")["started"]);
  EXPECT_EQ(read_json("all.json")["ended"], read_json("r.1.json")["ended"]);
  EXPECT_EQ(batch({"--shard", "2/2"}).exit, 2);
}

TEST_F(BatchTest, WhatIsWrongIsToldBeforeAnythingRuns) {
  EXPECT_EQ(run({"batch", "g.kg.json", "--out", "done"}).exit, 2);
  EXPECT_EQ(run({"batch", "g.kg.json", "--each", "clip.file=none/*.bvh", "--out", "done"}).exit, 2);
  EXPECT_EQ(run({"batch", "g.kg.json", "--each", "nobody.file=clips/*.bvh", "--out", "done"}).exit, 2);
  write("g.kg.json", "{");
  EXPECT_EQ(batch({}).exit, 3);
  EXPECT_FALSE(exists("done"));
}

// Over all real clips. Each kill strikes while some items are done and others are not: a run that ends before
// it is taken back and run again.
class KilledBatch : public ProgramTest {
 protected:
  std::vector<std::string> arguments(const std::string& out) const {
    return {"batch", "g.kg.json", "--each",   "clip.file=" + mocap("cmu/bvh/*.bvh"),
            "--out", out,         "--resume", "--progress",
            "none",  "--threads", "1"};
  }
  // Path -> the file's text; what a killed process was writing is hidden, and no output.
  std::map<std::string, std::string> written(const std::string& out) const {
    std::map<std::string, std::string> all;
    for (const auto& file : files())
      if (file.starts_with(out + "/") && !file.starts_with(out + "/.kinegraph") && !file.ends_with(".tmp") &&
          !is_folder(file))
        all[file.substr(out.size() + 1)] = read(file);
    return all;
  }
  std::size_t records() const {
    std::size_t count = 0;
    for (const auto& file : files()) count += file.starts_with("done/.kinegraph/") && file.ends_with(".json");
    return count;
  }
  bool is_folder(const std::string& file) const { return std::filesystem::is_directory(path(file)); }

  // Kills it when one more item is done than before. False: it was through by then.
  bool killed_on_its_way(std::size_t items) {
    const std::size_t before = records();
    const auto running = start(arguments("done"));
    for (int i = 0; i < 20000 && records() == before; ++i) usleep(500);
    ::kill(running.process, SIGKILL);
    return wait(running).exit == 128 + SIGKILL && records() > before && records() < items;
  }
};

TEST_F(KilledBatch, TwiceAndResumedEndsWithEveryOutputOnce) {
  KINEGRAPH_NEEDS_MOCAP();
  write("g.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": "none.bvh"}},
      "smooth": {"type": "Filter", "inputs": {"motion": "clip.motion"}},
      "out": {"type": "Export", "params": {"file": "smooth.bvh"}, "inputs": {"motion": "smooth.motion"}})"));
  ASSERT_EQ(run(arguments("whole")).exit, 0);
  const auto whole = written("whole");
  std::size_t clips = 0;
  for (const auto& clip : std::filesystem::directory_iterator(mocap("cmu/bvh")))
    clips += clip.path().extension() == ".bvh";
  ASSERT_EQ(whole.size(), clips);
  int strikes = 0;
  for (int attempt = 0; attempt < 50 && strikes < 2; ++attempt) {
    if (killed_on_its_way(clips))
      ++strikes;
    else if (records() == clips)
      strikes = 0, std::filesystem::remove_all(path("done"));
  }
  ASSERT_EQ(strikes, 2);
  const std::size_t kept = records();
  EXPECT_GE(kept, 2u);
  const Ran resumed = run(arguments("done"));
  EXPECT_EQ(resumed.exit, 0) << resumed.err;
  EXPECT_THAT(resumed.out, HasSubstr(std::to_string(kept) + " skipped"));
  EXPECT_EQ(records(), clips);
  EXPECT_TRUE(written("done") == whole) << "other files, or other bytes, than of a batch that nobody killed";
}

}  // namespace
}  // namespace kinegraph
