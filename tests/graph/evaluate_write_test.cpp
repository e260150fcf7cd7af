// Nodes that write files: only when asked for, where they may, whole or not at all, and never two on one
// file.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "graph/evaluate/writes.h"
#include "tests/graph/evaluate_toys.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using enum NodeState;

class EvaluateWrite : public toys::World {
 protected:
  static std::string save(const std::string& name, const std::string& params) {
    return ", \"" + name + R"(": {"type": "Save", "params": {"tag": ")" + name + "\", " + params +
           R"(}, "inputs": {"numbers": "n.numbers"}})";
  }
  RunLog run_saves(const std::string& saves, const std::vector<std::string>& names) {
    std::vector<Target> targets;
    for (const auto& name : names) targets.push_back({name, ""});
    return run(R"("n": {"type": "Count", "params": {"tag": "n", "value": 5}})" + saves, targets);
  }
  // Temporary names that were not cleaned up, anywhere.
  std::vector<std::string> leftovers() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path))
      if (entry.path().extension() == ".tmp") all.push_back(entry.path().string());
    return all;
  }
  const std::string five = "5.000000\n";
};

TEST_F(EvaluateWrite, RunsOnlyWhenAskedForAndMakesMissingFolders) {
  const auto saves = save("one", R"("file": "a/b/one.txt")") + save("two", R"("file": "two.txt")");
  const auto log = run_saves(saves, {"one"});
  EXPECT_EQ(state(log, "one"), done);
  EXPECT_EQ(state(log, "two"), skipped);
  EXPECT_EQ(toys::content(folder / "out/a/b/one.txt"), five);
  EXPECT_FALSE(fs::exists(folder / "out/two.txt"));
  ASSERT_EQ(log.files.size(), 1u);
  EXPECT_EQ(log.files[0].node, "one");
  EXPECT_EQ(log.files[0].path, folder / "out/a/b/one.txt");
  EXPECT_EQ(log.files[0].bytes, five.size());
  EXPECT_EQ(log.files[0].content, five);
  EXPECT_EQ(log.planned_files, std::vector<std::string>{folder / "out/a/b/one.txt"});
  EXPECT_TRUE(leftovers().empty());
}

TEST_F(EvaluateWrite, TwoOfOneKeyBothWrite) {
  const auto log =
      run_saves(save("one", R"("file": "one.txt")") + save("two", R"("file": "two.txt")"), {"one", "two"});
  EXPECT_EQ(log.nodes.at("one").key, log.nodes.at("two").key);
  EXPECT_EQ(toys::content(folder / "out/one.txt"), five);
  EXPECT_EQ(toys::content(folder / "out/two.txt"), five);
  ASSERT_EQ(log.files.size(), 2u);
  EXPECT_EQ(log.files[1].node, "two") << "in the plan's order";
}

TEST_F(EvaluateWrite, InsideANestedFileTheyDoNotRun) {
  auto plan = plan_of(R"("n": {"type": "Count"})" + save("one", R"("file": "one.txt")"));
  auto nested = plan.nodes[static_cast<std::size_t>(plan.by_name.at("one"))];
  nested.name = "outer/one";
  plan.by_name[nested.name] = static_cast<int>(plan.nodes.size());
  plan.nodes.push_back(nested);
  const auto log = run(plan, {{"outer/one", ""}});
  ASSERT_EQ(log.diagnostics.size(), 1u);
  EXPECT_EQ(log.diagnostics[0].code, "nested-effect");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(EvaluateWrite, RunsAgainEachTimeWithItsInputsFromTheCache) {
  memory.emplace(1 << 20);
  const auto saves = save("one", R"("file": "one.txt")");
  run_saves(saves, {"one"});
  toys::write(folder / "out/one.txt", "overwritten by someone");
  const auto log = run_saves(saves, {"one"});
  EXPECT_EQ(trace.times("one"), 2);
  EXPECT_EQ(trace.times("n"), 1);
  EXPECT_EQ(log.nodes.at("n").outputs.at("numbers").cached, "memory");
  EXPECT_EQ(toys::content(folder / "out/one.txt"), five);
}

TEST_F(EvaluateWrite, ADryRunWritesNothing) {
  options.dry_run = true;
  const auto log = run_saves(save("one", R"("file": "one.txt")"), {"one"});
  EXPECT_EQ(log.nodes.at("one").forecast, Forecast::run);
  EXPECT_EQ(log.planned_files.size(), 1u);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(EvaluateWrite, TwoOnOneFileIsAnErrorBeforeAnythingRuns) {
  fs::create_directories(folder / "out/real");
  fs::create_directory_symlink("real", folder / "out/link");
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {R"("file": "one.txt")", R"("file": "one.txt")"},
      {R"("file": "one.txt")", R"("file": "./x/../one.txt")"},
      {R"("file": "real/one.txt")", R"("file": "link/one.txt")"},
      {R"("file": "one.txt", "companion": "more.bin")", R"("file": "two.txt", "companion": "more.bin")"},
      {R"("file": "one.txt", "companion": "two.txt")", R"("file": "two.txt")"}};
  for (const auto& [a, b] : pairs) {
    trace.counts.clear();
    const auto log = run_saves(save("one", a) + save("two", b), {"one", "two"});
    EXPECT_TRUE(log.refused) << b;
    EXPECT_EQ(first_code(log, "two"), "shared-file") << b;
    EXPECT_EQ(trace.times(), 0);
    EXPECT_EQ(state(log, "one"), cancelled);
    EXPECT_TRUE(log.files.empty());
    EXPECT_FALSE(run_saves(save("one", a) + save("two", b), {"one"}).refused) << "alone it may";
  }
}

TEST_F(EvaluateWrite, WritingOntoAFileThatIsReadOrAGraphIsAnError) {
  options.out = folder.path;
  toys::write(folder / "clip.txt", "walk");
  toys::write(folder / "clip.txt.more", "x");
  fs::create_hard_link(folder / "clip.txt", folder / "hard.txt");
  fs::create_symlink("clip.txt", folder / "soft.txt");
  const auto code = [&](const std::string& file) {
    const auto log = run(
        R"("n": {"type": "Read", "params": {"file": "clip.txt"}})" + save("one", "\"file\": \"" + file + '"'),
        {{"one", ""}});
    EXPECT_EQ(log.refused, state(log, "one") == failed) << file;
    return first_code(log, "one");
  };
  EXPECT_EQ(code("clip.txt"), "writes-onto-input");
  EXPECT_EQ(code("clip.txt.more"), "writes-onto-input");
  EXPECT_EQ(code("soft.txt"), "writes-onto-input");
  EXPECT_EQ(code("test.kg.json"), "writes-onto-graph");
  EXPECT_EQ(code("other.kg.json"), "writes-onto-graph");
  EXPECT_EQ(code("hard.txt"), "") << "renaming takes the name, not the file";
  EXPECT_EQ(toys::content(folder / "clip.txt"), "walk");
}

TEST_F(EvaluateWrite, NothingLeavesTheOutputFolder) {
  fs::create_directories(folder / "out");
  toys::write(folder / "elsewhere/victim.txt", "mine");
  fs::create_directory_symlink(folder / "elsewhere", folder / "out/link");
  fs::create_symlink(folder / "elsewhere/victim.txt", folder / "out/victim.txt");
  fs::create_symlink(folder / "elsewhere/fresh.txt", folder / "out/fresh.txt");
  fs::create_directory_symlink(folder / "nowhere", folder / "out/dangling");
  for (const std::string& file : {std::string("../one.txt"), std::string("x/../../one.txt"),
                                  folder / "one.txt", std::string("link/one.txt"), std::string("victim.txt"),
                                  std::string("fresh.txt"), std::string("dangling/one.txt")}) {
    const auto log = run_saves(save("one", "\"file\": \"" + file + '"'), {"one"});
    EXPECT_TRUE(log.refused) << file;
    EXPECT_EQ(first_code(log, "one"), "write-outside") << file;
    EXPECT_EQ(log.nodes.at("one").diagnostics.at(0).param, "file");
  }
  EXPECT_FALSE(fs::exists(folder / "one.txt"));
  EXPECT_FALSE(fs::exists(folder / "elsewhere/one.txt"));
  EXPECT_EQ(toys::content(folder / "elsewhere/victim.txt"), "mine");
  EXPECT_FALSE(fs::exists(folder / "nowhere"));
}

TEST_F(EvaluateWrite, UnlessItIsAllowed) {
  auto log = run_saves(save("one", R"("file": "../other/one.txt", "companion": "one.bin")"), {"one"});
  EXPECT_TRUE(log.refused);
  options.outside_allowed = {folder / "other/one.txt"};
  log = run_saves(save("one", R"("file": "../other/one.txt", "companion": "one.bin")"), {"one"});
  EXPECT_FALSE(log.refused);
  EXPECT_EQ(toys::content(folder / "other/one.txt"), five);
  EXPECT_EQ(toys::content(folder / "other/one.bin"), "companion");
  log = run_saves(save("one", R"("file": "../other/two.txt")"), {"one"});
  EXPECT_TRUE(log.refused);
  options.allow_outside = true;
  log = run_saves(save("one", R"("file": "../other/two.txt")"), {"one"});
  EXPECT_EQ(state(log, "one"), done);
  EXPECT_EQ(toys::content(folder / "other/two.txt"), five);
}

TEST_F(EvaluateWrite, ALinkWithinTheFolderIsFollowedToItsFile) {
  toys::write(folder / "out/real.txt", "old");
  fs::create_symlink("real.txt", folder / "out/link.txt");
  const auto log = run_saves(save("one", R"("file": "link.txt")"), {"one"});
  EXPECT_EQ(state(log, "one"), done);
  EXPECT_TRUE(fs::is_symlink(folder / "out/link.txt"));
  EXPECT_EQ(toys::content(folder / "out/real.txt"), five);
}

TEST_F(EvaluateWrite, AFailingNodeLeavesTheOldFilesWhole) {
  toys::write(folder / "out/one.txt", "old");
  const auto log =
      run_saves(save("one", R"("file": "one.txt", "companion": "one.bin", "fail": true)"), {"one"});
  EXPECT_EQ(state(log, "one"), failed);
  EXPECT_EQ(toys::content(folder / "out/one.txt"), "old");
  EXPECT_FALSE(fs::exists(folder / "out/one.bin"));
  EXPECT_TRUE(log.files.empty());
  EXPECT_EQ(log.planned_files.size(), 2u) << "fewer were written than planned";
  EXPECT_FALSE(log.write_failed);
  EXPECT_TRUE(leftovers().empty());
}

TEST_F(EvaluateWrite, AWriteThatFailsIsToldAndLeavesNothing) {
  fs::create_directories(folder / "out/folder");
  toys::write(folder / "out/file", "x");
  for (const char* file : {"folder", "file/one.txt"}) {
    const auto log = run_saves(save("one", std::string("\"file\": \"") + file + '"'), {"one"});
    EXPECT_TRUE(log.write_failed) << file;
    EXPECT_FALSE(log.refused) << file;
    EXPECT_EQ(first_code(log, "one"), "cannot-write");
  }
  EXPECT_TRUE(leftovers().empty());
}

TEST_F(EvaluateWrite, AFullDiskLeavesNothingHalfWritten) {
  const std::string path = folder / "out/large.txt";
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::string code;
    try {
      StagedFiles staged;
      staged.add(path, std::string(100'000, 'x'), [] {});
      staged.put_in_place();
    } catch (const Failure& failure) {
      code = failure.diagnostic().code;
    }
    ::_exit(code == "cannot-write" ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_FALSE(fs::exists(path));
  EXPECT_TRUE(leftovers().empty());
}

TEST_F(EvaluateWrite, StoppedWhileALargeFileIsWrittenItLeavesNothing) {
  const std::string path = folder / "out/large.txt", bytes(std::size_t{8} << 20, 'x');
  const auto left = [&] { return fs::exists(path) || !leftovers().empty(); };
  for (int last = 1; last <= 8; ++last) {
    int asked = 0;
    try {
      StagedFiles staged;
      staged.add(path, bytes, [&] {
        EXPECT_EQ(left(), true) << "it is being written aside";
        if (++asked == last) throw Cancelled();
      });
      FAIL() << "a megabyte went by without asking: " << asked;
    } catch (const Cancelled&) {
    }
    EXPECT_FALSE(left()) << last;
  }
}

TEST_F(EvaluateWrite, DisabledOnesDoNotRun) {
  const auto log = run(R"("n": {"type": "Count"}, "one": {"type": "Save", "enabled": false,
    "params": {"file": "one.txt"}, "inputs": {"numbers": "n.numbers"}})",
                       {{"one", ""}});
  EXPECT_EQ(state(log, "one"), disabled);
  EXPECT_TRUE(log.planned_files.empty());
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(EvaluateWrite, KeepsThePermissionsOfTheFileItReplaces) {
  toys::write(folder / "out/one.txt", "old");
  ::chmod((folder / "out/one.txt").c_str(), 0640);
  run_saves(save("one", R"("file": "one.txt")"), {"one"});
  struct stat info {};
  ASSERT_EQ(::stat((folder / "out/one.txt").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
  EXPECT_EQ(toys::content(folder / "out/one.txt"), five);
}

}  // namespace
}  // namespace kinegraph
