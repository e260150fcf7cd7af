// The disk cache and files in a run: warnings, damage, files that change.
#include <fcntl.h>
#include <sys/stat.h>

#include "graph/cache/cache_folder.h"
#include "tests/graph/evaluate_toys.h"

namespace kinegraph {
namespace {

using toys::numbers;
using enum NodeState;

class EvaluateCache : public toys::World {
 protected:
  EvaluateCache() { disk.emplace(folder / "cache", 0, registry); }
};

const std::string read_and_add = R"(
  "clip": {"type": "Read", "params": {"tag": "clip", "file": "clip.txt"}},
  "sum": {"type": "Add", "params": {"tag": "sum"}, "inputs": {"terms": ["clip.numbers"]}})";

TEST_F(EvaluateCache, WarningsBelongToTheKeyAndComeBackUnderTheAskingNodesNameAndFile) {
  toys::write(folder / "clip.txt", "warn");
  toys::write(folder / "sub/other.txt", "warn");
  memory.emplace(1 << 20);
  const auto told = [&](const RunLog& log, const std::string& node, const std::string& file) {
    const auto& diagnostics = log.nodes.at(node).diagnostics;
    ASSERT_EQ(diagnostics.size(), 1u) << node;
    EXPECT_EQ(diagnostics[0].code, "odd");
    EXPECT_EQ(diagnostics[0].node, node);
    EXPECT_EQ(diagnostics[0].file, file);
    EXPECT_EQ(diagnostics[0].place.column, 5);
    EXPECT_EQ(diagnostics[0].message, "an odd word in " + file);
  };
  const std::string other =
      R"("other": {"type": "Read", "params": {"tag": "other", "file": "sub/other.txt"}})";
  told(run(read_and_add, {{"clip", ""}}), "clip", "clip.txt");
  told(run(read_and_add, {{"clip", ""}}), "clip", "clip.txt");
  told(run(other, {{"other", ""}}), "other", "sub/other.txt");
  forget();
  told(run(other, {{"other", ""}}), "other", "sub/other.txt");
  EXPECT_EQ(trace.times(), 0);
  for (const auto& file : cache_files(folder / "cache"))
    EXPECT_EQ(toys::content(file.path).find(folder.path), std::string::npos) << "no path in the cache";
}

TEST_F(EvaluateCache, TwoNodesOfOneKeyEachTellTheWarning) {
  toys::write(folder / "a.txt", "warn");
  toys::write(folder / "b.txt", "warn");
  const auto log = run(R"(
    "a": {"type": "Read", "params": {"tag": "r", "file": "a.txt"}},
    "b": {"type": "Read", "params": {"tag": "r", "file": "b.txt"}})",
                       {{"a", ""}, {"b", ""}});
  EXPECT_EQ(trace.times("r"), 1);
  EXPECT_EQ(log.nodes.at("a").diagnostics.at(0).file, "a.txt");
  EXPECT_EQ(log.nodes.at("b").diagnostics.at(0).file, "b.txt");
}

TEST_F(EvaluateCache, ADamagedEntryIsComputedAgainWithAWarningAndReplaced) {
  toys::write(folder / "clip.txt", "walk");
  const auto plan = plan_of(read_and_add);
  run(plan, {{"sum", "sum"}});
  const auto good = numbers(evaluator().value(plan, "sum", "sum"));
  for (const auto& file : cache_files(folder / "cache")) toys::write(file.path, "damaged");
  forget();
  auto log = run(plan, {{"sum", "sum"}});
  EXPECT_EQ(state(log, "sum"), done);
  EXPECT_EQ(numbers(evaluator().value(plan, "sum", "sum")), good);
  EXPECT_EQ(trace.times("clip"), 1);
  EXPECT_EQ(trace.times("sum"), 1);
  ASSERT_EQ(log.diagnostics.size(), 1u);
  EXPECT_EQ(log.diagnostics[0].code, "cache-damaged");
  EXPECT_EQ(DiskCache::verify(folder / "cache", {}).damaged, 0u);
  forget();
  log = run(plan, {{"sum", "sum"}});
  EXPECT_EQ(trace.times(), 0);
  EXPECT_TRUE(log.diagnostics.empty());
}

TEST_F(EvaluateCache, AHitOnDiskNeedsNothingBeforeIt) {
  toys::write(folder / "clip.txt", "walk");
  run(read_and_add, {{"sum", "sum"}});
  forget();
  const auto log = run(read_and_add, {{"sum", "sum"}});
  EXPECT_EQ(log.nodes.at("sum").outputs.at("sum").cached, "disk");
  EXPECT_EQ(state(log, "clip"), skipped);
  options.dry_run = true;
  const auto before = DiskCache::stat(folder / "cache").entries;
  EXPECT_EQ(run(read_and_add, {{"clip", ""}, {"sum", ""}}).nodes.at("sum").forecast, Forecast::hit);
  EXPECT_EQ(DiskCache::stat(folder / "cache").entries, before);
}

TEST_F(EvaluateCache, ErrorsAndWhatWasStoppedAreNeverCached) {
  memory.emplace(1 << 20);
  const std::string nodes = R"("bad": {"type": "Bad", "params": {"tag": "bad"}}, "spin": {"type": "Spin"})";
  run(nodes, {{"bad", ""}});
  run(nodes, {{"bad", ""}});
  EXPECT_EQ(trace.times("bad"), 2);
  options.timeout = 0.02;
  run(nodes, {{"spin", ""}});
  EXPECT_EQ(DiskCache::stat(folder / "cache").entries, 0u);
  EXPECT_EQ(memory->bytes(), 0u);
}

TEST_F(EvaluateCache, AnUnwritableCacheIsAWarningOnly) {
  toys::write(folder / "file", "not a folder");
  disk.emplace(folder / "file", 0, registry);
  const auto log = run(R"("n": {"type": "Count"})", {{"n", ""}});
  EXPECT_EQ(state(log, "n"), done);
  ASSERT_EQ(log.diagnostics.size(), 1u);
  EXPECT_EQ(log.diagnostics[0].severity, Severity::warning);
}

TEST_F(EvaluateCache, AFileThatChangedBeforeItIsReadStartsTheNodeOnceMoreUnderTheNewKey) {
  toys::write(folder / "clip.txt", "walk");
  int reads = 0;
  trace.on_read = [&](const std::string& path) {
    if (++reads == 1) toys::write(path, "jump!");
  };
  const auto plan = plan_of(read_and_add);
  auto log = run(plan, {{"sum", "sum"}, {"clip", ""}});
  EXPECT_EQ(reads, 2);
  EXPECT_EQ(state(log, "sum"), done);
  EXPECT_EQ(numbers(evaluator().value(plan, "clip", "numbers")).front(), 'j');
  const auto key = log.nodes.at("sum").outputs.at("sum").key;
  trace.on_read = nullptr;
  forget();
  log = run(plan, {{"sum", "sum"}});
  EXPECT_EQ(trace.times(), 0) << "what follows is cached under its new key too";
  EXPECT_EQ(log.nodes.at("sum").outputs.at("sum").key, key);

  toys::write(folder / "clip.txt", "walk");
  forget();
  log = run(plan, {{"sum", "sum"}});
  EXPECT_EQ(trace.times("sum"), 1) << "nothing stands under the old key";
  EXPECT_EQ(numbers(evaluator().value(plan, "sum", "sum")), std::vector<double>{'w'});
}

TEST_F(EvaluateCache, AFileThatKeepsChangingFailsTheNode) {
  toys::write(folder / "clip.txt", "walk");
  int reads = 0;
  trace.on_read = [&](const std::string& path) { toys::write(path, "walk" + std::to_string(++reads)); };
  const auto log = run(read_and_add, {{"sum", "sum"}});
  EXPECT_EQ(reads, 2);
  EXPECT_EQ(state(log, "clip"), failed);
  EXPECT_EQ(first_code(log, "clip"), "file-changed");
  EXPECT_EQ(log.nodes.at("clip").diagnostics[0].param, "file");
  EXPECT_EQ(state(log, "sum"), blocked);
  EXPECT_EQ(DiskCache::stat(folder / "cache").entries, 0u);
}

TEST_F(EvaluateCache, OfTwoFilesWithOneContentOnlyTheOneThatChangesGetsANewKey) {
  toys::write(folder / "a.txt", "walk");
  toys::write(folder / "b.txt", "walk");
  disk.reset();
  for (int threads : {1, 4}) {
    options.threads = threads;
    toys::write(folder / "a.txt", "walk");
    trace.on_read = [&](const std::string& path) {
      if (path == folder / "a.txt") toys::write(path, "jump");
    };
    const auto plan = plan_of(R"(
      "a": {"type": "Read", "params": {"file": "a.txt"}},
      "b": {"type": "Read", "params": {"file": "b.txt"}},
      "sum": {"type": "Add", "inputs": {"terms": ["a.numbers"], "extra": "b.numbers"}})");
    run(plan, {{"sum", "sum"}});
    const auto value = evaluator().value(plan, "sum", "sum");
    ASSERT_TRUE(value);
    const auto sum = numbers(value);
    EXPECT_TRUE(sum == (std::vector<double>{'j', 'w'}) || sum == (std::vector<double>{'w', 'w'}))
        << "b is never what a has become";
  }
}

TEST_F(EvaluateCache, AMissingFileFailsItsNodeAndNamesThePathAsWritten) {
  const auto log = run(read_and_add, {{"sum", "sum"}});
  EXPECT_EQ(state(log, "clip"), failed);
  const auto& told = log.nodes.at("clip").diagnostics.at(0);
  EXPECT_EQ(told.code, "missing-file");
  EXPECT_EQ(told.param, "file");
  EXPECT_EQ(told.message, "there is no file 'clip.txt'");
}

}  // namespace
}  // namespace kinegraph
